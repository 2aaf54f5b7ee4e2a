// SPDX-License-Identifier: BSD-3-Clause
#include "io/content.h"
#include "io/input_bytes.h"
#include "io/mesh_readers.h"

namespace pcl_gpf {

namespace {

/** OFF, with the letters that promise texture coordinates, colours, normals. */
bool startsWithOff(const Source& source) {
  LineReader lines(source, byteOrderMark(source, nullptr));
  std::string_view line;
  std::string_view token;
  while (lines.nextFilled(line)) {
    takeToken(line, token);
    if (token[0] != '#') return token.size() >= 3 && token.size() <= 6 && token.substr(token.size() - 3) == "OFF";
  }
  return false;
}

} // namespace

TriangleMesh readMeshBuffer(const unsigned char* data, std::size_t size, const std::string& name) {
  const Source source{data, size, name};
  if (size == 0) source.fail("a PLY, OFF or OBJ mesh", "an empty file");
  if (detectContent(source) == Content::Ply) return readMeshPly(source);
  if (startsWithOff(source)) return readMeshOff(source);
  if (extensionOf(name) == ".obj") return readMeshObj(source);
  source.fail("a PLY or OFF mesh (or OBJ under the extension .obj)", "something else");
}

TriangleMesh readMesh(const std::string& path) {
  const InputBytes bytes = readInput(path, [](const unsigned char*, std::size_t) {});
  return readMeshBuffer(bytes.data.get(), bytes.size, path == "-" ? "standard input" : path);
}

void appendFan(const std::vector<std::uint32_t>& polygon, TriangleMesh& mesh) {
  for (std::size_t k = 2; k < polygon.size(); ++k)
    mesh.triangles.insert(mesh.triangles.end(), {polygon[0], polygon[k - 1], polygon[k]});
}

} // namespace pcl_gpf
