// SPDX-License-Identifier: BSD-3-Clause
// One fuzz target for every reader, with the writers behind them: bytes in, and nothing but success or IoError out.
// libFuzzer: clang++ -fsanitize=fuzzer,address,undefined with this file and the sources of the input/output layer.
// Without libFuzzer, mutate_readers.cpp drives it.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/mesh_file.h"
#include "pcl_gpf/io/read_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_gpf;
  try {
    const CloudFile cloud = readCloudBuffer(data, size, "fuzz.xyz");
    const bool is_whole = cloud.data.size() == cloud.size() * cloud.pointStep() && cloud.finiteCount() <= cloud.size();
    // Rule 3 of the readers: memory is bounded by the file (LZF unpacks at most 88-fold, text and bytes 12-fold).
    const bool is_bounded = cloud.data.size() <= 100 * size + 64;
    if (!is_whole || !is_bounded) std::abort();
  } catch (const IoError&) {
  }
  try {
    const TriangleMesh mesh = readMeshBuffer(data, size, "fuzz.obj");
    for (const std::uint32_t index : mesh.triangles)
      if (index >= mesh.vertexCount()) std::abort();
  } catch (const IoError&) {
  }
  return 0;
}
