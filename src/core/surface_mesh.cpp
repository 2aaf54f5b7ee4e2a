// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/surface_mesh.h>

#include "check_range.h"
#include "mesh_components.h"

#include <algorithm>
#include <numeric>

namespace pcl_gpf {

std::vector<std::uint32_t>
componentRoots(const SurfaceMesh& mesh)
{
  std::vector<std::uint32_t> parent(mesh.vertexCount());
  std::iota(parent.begin(), parent.end(), std::uint32_t{0});
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v)
      v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint32_t a = root(mesh.triangles[t]), b = root(mesh.triangles[t + k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < parent.size(); ++v)
    parent[v] = root(v);
  return parent;
}

std::vector<std::size_t>
componentSizes(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& roots)
{
  std::vector<std::size_t> sizes(mesh.vertexCount());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    ++sizes[roots[mesh.triangles[t]]];
  return sizes;
}

MeshTopology
meshTopology(const SurfaceMesh& mesh)
{
  MeshTopology topology;
  // Key: the lesser vertex, the greater, and in which direction the triangle runs.
  struct HalfEdge {
    std::uint64_t key;
    bool forward;
    bool operator<(const HalfEdge& other) const { return key < other.key; }
  };
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(mesh.triangles.size());
  std::vector<std::uint8_t> used(mesh.vertexCount());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.triangles[t + k], b = mesh.triangles[t + (k + 1) % 3];
      half_edges.push_back({std::min(a, b) << 32 | std::max(a, b), a < b});
      used[a] = 1;
    }
  std::sort(half_edges.begin(), half_edges.end());
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    std::size_t forward = 0;
    for (end = begin; end < half_edges.size() && half_edges[end].key == half_edges[begin].key; ++end)
      forward += half_edges[end].forward;
    ++topology.edges;
    topology.open_edges += end - begin == 1;
    topology.inconsistent_edges += end - begin > 2 || (end - begin == 2 && forward != 1);
  }
  const std::vector<std::size_t> sizes = componentSizes(mesh, componentRoots(mesh));
  topology.components = sizes.size() - static_cast<std::size_t>(std::count(sizes.begin(), sizes.end(), std::size_t{0}));
  topology.euler_characteristic = static_cast<std::int64_t>(std::count(used.begin(), used.end(), std::uint8_t{1})) -
                                  static_cast<std::int64_t>(topology.edges) +
                                  static_cast<std::int64_t>(mesh.triangleCount());
  return topology;
}

std::size_t
removeSmallComponents(SurfaceMesh& mesh, double share)
{
  checkRange("smallest component", share, share >= 0.0 && share <= 1.0, "0 .. 1");
  if (share == 0.0 || mesh.triangles.empty())
    return 0;
  const std::vector<std::uint32_t> roots = componentRoots(mesh);
  const std::vector<std::size_t> sizes = componentSizes(mesh, roots);
  const double least = share * static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
  const auto isSmall = [&](std::size_t size) { return static_cast<double>(size) < least; };
  const auto removed =
      std::count_if(sizes.begin(), sizes.end(), [&](std::size_t size) { return size > 0 && isSmall(size); });
  if (removed == 0)
    return 0;
  std::vector<std::uint32_t> kept, place(mesh.vertexCount());
  for (std::uint32_t v = 0; v < roots.size(); ++v) {
    place[v] = static_cast<std::uint32_t>(kept.size());
    if (!isSmall(sizes[roots[v]]))
      kept.push_back(v);
  }
  std::vector<std::uint32_t> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    if (!isSmall(sizes[roots[mesh.triangles[t]]]))
      for (std::size_t k = 0; k < 3; ++k)
        triangles.push_back(place[mesh.triangles[t + k]]);
  mesh.triangles = std::move(triangles);
  mesh.vertices = elementsOf(mesh.vertices.view(), kept);
  if (mesh.normals.size() > 0)
    mesh.normals = elementsOf(mesh.normals.view(), kept);
  return static_cast<std::size_t>(removed);
}

} // namespace pcl_gpf
