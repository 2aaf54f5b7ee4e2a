// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/surface_mesh.h>

#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kVerticesPerTask = 4096;
constexpr std::uint32_t kUnused = 0xffffffffu;

/** Which vertices stay. */
std::vector<std::uint8_t>
verticesWithin(const SoaBuffer& v, const PointIndex& points, double distance, unsigned threads)
{
  std::vector<std::uint8_t> within(v.size());
  parallelBlocks(v.size(), kVerticesPerTask, resolveThreads(threads), [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    for (std::size_t i = begin; i < end; ++i) {
      within[i] = std::isfinite(v.x[i]) && std::isfinite(v.y[i]) && std::isfinite(v.z[i]);
      if (within[i] == 0 || std::isinf(distance))
        continue;
      points.tree().nearest(points.sorted(), {v.x[i], v.y[i], v.z[i]}, 1, distances_sq);
      within[i] = !distances_sq.empty() && std::sqrt(distances_sq.front()) <= distance; // none where squares overflow
    }
  });
  return within;
}

} // namespace

void
trimMesh(SurfaceMesh& mesh, const PointIndex& points, double distance, unsigned number_of_threads)
{
  const std::vector<std::uint8_t> kept = verticesWithin(mesh.vertices, points, distance, number_of_threads);
  std::vector<std::uint32_t> triangles, place(mesh.vertexCount(), kUnused), order;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t* v = mesh.triangles.data() + t;
    if (!kept[v[0]] || !kept[v[1]] || !kept[v[2]] || v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (place[v[k]] == kUnused) {
        place[v[k]] = static_cast<std::uint32_t>(order.size());
        order.push_back(v[k]);
      }
      triangles.push_back(place[v[k]]);
    }
  }
  if (mesh.normals.size() == mesh.vertexCount())
    mesh.normals = elementsOf(mesh.normals.view(), order);
  mesh.vertices = elementsOf(mesh.vertices.view(), order);
  mesh.triangles = std::move(triangles);
}

} // namespace pcl_gpf
