// SPDX-License-Identifier: BSD-3-Clause
#include "polygonizer.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kBricksPerTask = 512;
constexpr std::size_t kCellsPerTask = 8192;
/** Vertices keep this share of a cell from the ends of their edge, so that no two coincide. */
constexpr double kLeastShare = 1e-3;
/** Marks a vertex in the middle of a polygon; the number below it counts within the task. */
constexpr std::uint32_t kMiddle = 0x80000000u;

unsigned
bitCount(std::uint64_t bits)
{
#if defined(__GNUC__)
  return static_cast<unsigned>(__builtin_popcountll(bits));
#else
  unsigned count = 0;
  for (; bits != 0; bits &= bits - 1)
    ++count;
  return count;
#endif
}

/** Number of the vertex on an edge. */
std::uint32_t
vertexOnEdge(const SparseLattice::Brick& brick, unsigned axis, std::uint64_t bit)
{
  std::uint32_t number = brick.first_vertex;
  for (unsigned a = 0; a < axis; ++a)
    number += bitCount(brick.crossed[a]);
  return number + bitCount(brick.crossed[axis] & (bit - 1));
}

} // namespace

SurfaceMesh
Polygonizer::run()
{
  numberVertices();
  placeVertices();
  std::vector<TaskMesh> tasks((follower_.cells().size() + kCellsPerTask - 1) / kCellsPerTask);
  parallelBlocks(follower_.cells().size(), kCellsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    CornerFinder finder(lattice_);
    for (std::size_t i = begin; i < end; ++i)
      addCell(latticePoint(follower_.cells()[i]), finder, tasks[begin / kCellsPerTask]);
  });
  join(tasks);
  return std::move(mesh_);
}

void
Polygonizer::numberVertices()
{
  order_.resize(lattice_.brickCount());
  std::iota(order_.begin(), order_.end(), std::uint32_t{0});
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return lattice_.brick(a).key < lattice_.brick(b).key; });
  std::size_t count = 0;
  for (const std::uint32_t place : order_) {
    SparseLattice::Brick& brick = lattice_.brick(place);
    brick.first_vertex = static_cast<std::uint32_t>(count);
    count += bitCount(brick.crossed[0]) + bitCount(brick.crossed[1]) + bitCount(brick.crossed[2]);
  }
  if (count >= kMiddle)
    throw ExcessiveWork(std::to_string(count) + " vertices; the limit of a mesh is 2^31 - 1");
  mesh_.vertices = SoaBuffer(count);
}

void
Polygonizer::placeVertices()
{
  parallelBlocks(order_.size(), kBricksPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const SparseLattice::Brick& brick = lattice_.brick(order_[k]);
      std::uint32_t vertex = brick.first_vertex;
      for (unsigned axis = 0; axis < 3; ++axis)
        for (std::uint64_t local = 0; local < 64; ++local)
          if (brick.crossed[axis] >> local & 1u)
            placeVertex(vertex++, brick.key << 6 | local, axis, brick.values[local]);
    }
  });
}

void
Polygonizer::placeVertex(std::uint32_t vertex, std::uint64_t key, unsigned axis, float f0)
{
  const LatticePoint from = latticePoint(key);
  LatticePoint to = from;
  (axis == 0 ? to.x : axis == 1 ? to.y : to.z) += 1;
  const std::uint64_t to_key = latticeKey(to);
  const double f1 = lattice_.brick(lattice_.findBrick(to_key)).values[to_key & 63u];
  const double share = std::clamp(f0 / (f0 - f1), kLeastShare, 1.0 - kLeastShare);
  const std::array<float, 3> p = follower_.position(from, axis, share);
  mesh_.vertices.x[vertex] = p[0];
  mesh_.vertices.y[vertex] = p[1];
  mesh_.vertices.z[vertex] = p[2];
}

void
Polygonizer::addCell(LatticePoint cell, CornerFinder& finder, TaskMesh& task) const
{
  const std::array<CornerFinder::Corner, 8> corners = finder.corners(cell);
  float values[8];
  for (std::size_t c = 0; c < 8; ++c)
    values[c] = lattice_.brick(corners[c].brick).values[corners[c].key & 63u];
  const CellPolygons polygons = traceCell(values);
  const std::uint8_t* edges = polygons.edges.data();
  for (std::size_t p = 0; p < polygons.count; edges += polygons.sizes[p++]) {
    std::array<std::uint32_t, CellPolygons::kEdges> vertices{};
    for (std::size_t k = 0; k < polygons.sizes[p]; ++k) {
      const CornerFinder::Corner& corner = corners[edgeCorner(edges[k])];
      vertices[k] = vertexOnEdge(lattice_.brick(corner.brick), edgeAxis(edges[k]), SparseLattice::bitOf(corner.key));
    }
    addPolygon(vertices, edges, polygons.sizes[p], task);
  }
}

void
Polygonizer::addPolygon(const std::array<std::uint32_t, CellPolygons::kEdges>& vertices, const std::uint8_t* edges,
                        std::size_t size, TaskMesh& task) const
{
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    task.triangles.insert(task.triangles.end(), {a, b, c});
  };
  const std::size_t apex = fanApex(edges, size);
  if (apex < size) {
    for (std::size_t k = 1; k + 1 < size; ++k)
      add(vertices[apex], vertices[(apex + k) % size], vertices[(apex + k + 1) % size]);
    return;
  }
  const std::uint32_t middle = kMiddle + static_cast<std::uint32_t>(task.middles.size());
  std::array<double, 3> mean{};
  for (std::size_t k = 0; k < size; ++k) {
    add(middle, vertices[k], vertices[(k + 1) % size]);
    mean[0] += mesh_.vertices.x[vertices[k]] / static_cast<double>(size);
    mean[1] += mesh_.vertices.y[vertices[k]] / static_cast<double>(size);
    mean[2] += mesh_.vertices.z[vertices[k]] / static_cast<double>(size);
  }
  task.middles.push_back(mean);
}

void
Polygonizer::join(const std::vector<TaskMesh>& tasks)
{
  std::size_t triangles = 0, middles = 0;
  for (const TaskMesh& task : tasks) {
    triangles += task.triangles.size();
    middles += task.middles.size();
  }
  const std::size_t on_edges = mesh_.vertices.size();
  SoaBuffer all(on_edges + middles);
  std::copy_n(mesh_.vertices.x.data(), on_edges, all.x.data());
  std::copy_n(mesh_.vertices.y.data(), on_edges, all.y.data());
  std::copy_n(mesh_.vertices.z.data(), on_edges, all.z.data());
  mesh_.triangles.reserve(triangles);
  std::size_t next = on_edges;
  for (const TaskMesh& task : tasks) {
    for (const std::uint32_t vertex : task.triangles)
      mesh_.triangles.push_back(vertex < kMiddle ? vertex : static_cast<std::uint32_t>(next + (vertex - kMiddle)));
    for (const std::array<double, 3>& middle : task.middles) {
      all.x[next] = static_cast<float>(middle[0]);
      all.y[next] = static_cast<float>(middle[1]);
      all.z[next++] = static_cast<float>(middle[2]);
    }
  }
  mesh_.vertices = std::move(all);
}

} // namespace pcl_gpf
