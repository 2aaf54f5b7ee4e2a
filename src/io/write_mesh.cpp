// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/write_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "io/element_bytes.h"
#include "io/input_bytes.h"
#include "io/output_bytes.h"
#include "io/output_layout.h"
#include "pcl_gpf/io/atomic_file.h"
#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

/** Bytes gathered before they go to the file. */
constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

void validate(const MeshFile& file) {
  const std::size_t vertices = file.mesh.vertexCount();
  if (file.mesh.vertices.size() != 3 * vertices || file.mesh.triangles.size() % 3 != 0 ||
      (!file.normals.empty() && file.normals.size() != 3 * vertices) ||
      (!file.colors.empty() && file.colors.size() != 3 * vertices))
    throw std::invalid_argument("the arrays of the mesh do not fit together");
  if (vertices > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("a mesh file holds at most 2^31 - 1 vertices");
  for (const double coordinate : file.mesh.vertices)
    if (!std::isfinite(coordinate)) throw std::invalid_argument("a coordinate of the mesh is not finite");
  for (const std::uint32_t vertex : file.mesh.triangles)
    if (vertex >= vertices) throw std::invalid_argument("a triangle names a vertex that is not there");
  for (const std::string& comment : file.comments)
    if (comment.find_first_of("\r\n") != std::string::npos)
      throw std::invalid_argument("a comment of the mesh has more than one line");
}

std::string header(const MeshFile& file, bool double_coordinates) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : file.comments)
    text += "comment " + comment + '\n';
  text += "element vertex " + std::to_string(file.mesh.vertexCount()) + '\n';
  for (const char* axis : {"x", "y", "z"})
    text += std::string("property ") + (double_coordinates ? "double " : "float ") + axis + '\n';
  if (!file.normals.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!file.colors.empty()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  return text + "element face " + std::to_string(file.mesh.triangleCount()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

/** Collects values in little-endian order and passes them on block by block. */
class LittleEndianWriter {
public:
  explicit LittleEndianWriter(const ByteSink& sink)
      : sink_(sink) {}

  template <typename T>
  void put(T value) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (!kHostIsLittleEndian) swapElements(bytes, sizeof(T), 1);
    block_.insert(block_.end(), bytes, bytes + sizeof(T));
    if (block_.size() >= kBlockBytes) flush();
  }
  void flush() {
    if (!block_.empty()) sink_(block_.data(), block_.size());
    block_.clear();
  }

private:
  const ByteSink& sink_;
  std::vector<unsigned char> block_;
};

bool fitsFloat(const TriangleMesh& mesh) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](double c) { return std::abs(c) <= kLargest; });
}

void writeAs(const MeshFile& file, bool double_coordinates, const ByteSink& sink) {
  const std::string text = header(file, double_coordinates);
  sink(text.data(), text.size());
  LittleEndianWriter writer(sink);
  for (std::size_t v = 0; v < file.mesh.vertexCount(); ++v) {
    for (std::size_t k = 3 * v; k < 3 * v + 3; ++k) {
      if (double_coordinates)
        writer.put(file.mesh.vertices[k]);
      else
        writer.put(static_cast<float>(file.mesh.vertices[k]));
    }
    for (std::size_t k = 3 * v; k < 3 * v + 3 && !file.normals.empty(); ++k)
      writer.put(file.normals[k]);
    for (std::size_t k = 3 * v; k < 3 * v + 3 && !file.colors.empty(); ++k)
      writer.put(file.colors[k]);
  }
  for (std::size_t t = 0; t < file.mesh.triangles.size(); t += 3) {
    writer.put(std::uint8_t{3});
    for (std::size_t k = 0; k < 3; ++k)
      writer.put(static_cast<std::int32_t>(file.mesh.triangles[t + k]));
  }
  writer.flush();
}

} // namespace

void checkMeshWritable(const std::string& path, bool overwrite) {
  if (path != "-" && extensionOf(path) != ".ply")
    throw IoError(IoErrorKind::Unwritable, path, "", "the extension .ply for a mesh",
                  extensionOf(path).empty() ? "none" : "'" + extensionOf(path) + "'");
  checkWritable(path, overwrite);
}

void writeMesh(const MeshFile& mesh, const std::string& path, const MeshWriteOptions& options) {
  validate(mesh);
  checkMeshWritable(path, options.overwrite);
  const bool double_coordinates = options.double_coordinates || !fitsFloat(mesh.mesh);
  if (path == "-") {
    writeAs(mesh, double_coordinates, standardOutputSink());
    return;
  }
  AtomicFile file(path, options.overwrite);
  writeAs(mesh, double_coordinates,
          [&file](const void* bytes, std::size_t size) { file.write(bytes, size); });
  file.commit();
}

} // namespace pcl_gpf
