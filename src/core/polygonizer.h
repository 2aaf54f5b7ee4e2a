// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cell_polygons.h"
#include "surface_follower.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Makes the mesh of the cells that a SurfaceFollower found: vertices on the crossed edges, numbered brick by
 * brick. */
class Polygonizer {
public:
  Polygonizer(SurfaceFollower& follower, std::size_t threads)
  : follower_(follower), lattice_(follower.lattice()), threads_(threads)
  {}

  /** \brief The mesh without normals. \throws ExcessiveWork beyond 2^31 - 1 vertices */
  SurfaceMesh
  run();

private:
  /** Triangles of one task's cells. */
  struct TaskMesh {
    std::vector<std::uint32_t> triangles;
    std::vector<std::array<double, 3>> middles;
  };

  void
  numberVertices();
  void
  placeVertices();
  void
  placeVertex(std::uint32_t vertex, std::uint64_t key, unsigned axis, float f0);
  void
  addCell(LatticePoint cell, CornerFinder& finder, TaskMesh& task) const;
  void
  addPolygon(const std::array<std::uint32_t, CellPolygons::kEdges>& vertices, const std::uint8_t* edges,
             std::size_t size, TaskMesh& task) const;
  void
  join(const std::vector<TaskMesh>& tasks);

  SurfaceFollower& follower_;
  SparseLattice& lattice_;
  std::size_t threads_;
  std::vector<std::uint32_t> order_; ///< bricks by key
  SurfaceMesh mesh_;
};

} // namespace pcl_gpf
