// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/surface_mesh.h>

#include "mesh_components.h"

#include <algorithm>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::uint32_t kPinched = 0xfffffffeu;

/** For every vertex on a border the next one along the hole; kPinched where several holes meet. */
std::vector<std::uint32_t>
holeEdges(const SurfaceMesh& mesh)
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> half_edges; // lesser and greater vertex; where the triangle's edge begins
  half_edges.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = mesh.triangles[t + k], b = mesh.triangles[t + (k + 1) % 3];
      half_edges.emplace_back(std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(a));
    }
  std::sort(half_edges.begin(), half_edges.end());
  std::vector<std::uint32_t> next(mesh.vertexCount(), kNone);
  for (std::size_t i = 0; i < half_edges.size(); ++i) {
    const std::uint64_t key = half_edges[i].first;
    if ((i > 0 && half_edges[i - 1].first == key) || (i + 1 < half_edges.size() && half_edges[i + 1].first == key))
      continue;
    const std::uint32_t begin = half_edges[i].second, end = static_cast<std::uint32_t>((key >> 32) + (key & kNone) - begin);
    next[end] = next[end] == kNone ? begin : kPinched;
  }
  return next;
}

/** Vertices round the hole that begins at `start`, taken out of `next`; empty when it is pinched or has more than `most`. */
std::vector<std::uint32_t>
takeHole(std::uint32_t start, std::size_t most, std::vector<std::uint32_t>& next)
{
  std::vector<std::uint32_t> loop;
  std::uint32_t v = start;
  do {
    const std::uint32_t following = next[v];
    if (following == kNone || following == kPinched)
      return {};
    loop.push_back(v);
    next[v] = kNone;
    v = following;
  } while (v != start);
  return loop.size() >= 3 && loop.size() <= most ? loop : std::vector<std::uint32_t>();
}

SoaBuffer
withVertices(const SoaBuffer& old, const std::vector<std::vector<std::uint32_t>>& loops)
{
  SoaBuffer all(old.size() + loops.size());
  const AlignedArray<float>* from[3] = {&old.x, &old.y, &old.z};
  AlignedArray<float>* to[3] = {&all.x, &all.y, &all.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::copy_n(from[axis]->data(), old.size(), to[axis]->data());
    for (std::size_t i = 0; i < loops.size(); ++i) {
      double sum = 0.0;
      for (const std::uint32_t v : loops[i])
        sum += (*from[axis])[v];
      (*to[axis])[old.size() + i] = static_cast<float>(sum / static_cast<double>(loops[i].size()));
    }
  }
  return all;
}

} // namespace

std::size_t
fillSmallHoles(SurfaceMesh& mesh, std::size_t most_edges)
{
  if (most_edges < 3)
    return 0;
  std::vector<std::uint32_t> next = holeEdges(mesh);
  const std::vector<std::uint32_t> roots = componentRoots(mesh);
  const std::vector<std::size_t> sizes = componentSizes(mesh, roots);
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::uint32_t v = 0; v < next.size(); ++v) {
    std::vector<std::uint32_t> loop = takeHole(v, most_edges, next);
    // The rim of a small patch is no hole: a flat patch has fewer than a fifth as many triangles as its rim's square.
    if (!loop.empty() && sizes[roots[loop.front()]] >= loop.size() * loop.size())
      loops.push_back(std::move(loop));
  }
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t k = 0; k < loops[i].size(); ++k)
      mesh.triangles.insert(mesh.triangles.end(), {loops[i][k], loops[i][(k + 1) % loops[i].size()],
                                                   static_cast<std::uint32_t>(mesh.vertexCount() + i)});
  if (mesh.normals.size() == mesh.vertexCount())
    mesh.normals = withVertices(mesh.normals, loops);
  mesh.vertices = withVertices(mesh.vertices, loops);
  if (mesh.normals.size() == mesh.vertexCount())
    completeNormals(mesh);
  return loops.size();
}

} // namespace pcl_gpf
