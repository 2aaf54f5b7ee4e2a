// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/implicit_function.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/surface_mesh.h>

#include <array>
#include <cstddef>

namespace pcl_gpf {

/** \brief Parameters of the sparse marching cubes. */
struct MarchingCubesParameters {
  /** Edge of a cell in the unit of the positions, > 0. */
  double cell_size = 0.0;

  /** Where the lattice has a corner; the surface must lie within 500,000 cells of it. */
  std::array<double, 3> origin{0.0, 0.0, 0.0};

  /** Bytes that lattice and mesh may take, >= 1; passing them ends the work with ExcessiveWork. */
  std::size_t memory_limit = std::size_t{2} << 30;

  /** Evaluate the gradient at the vertices for their normals; false leaves SurfaceMesh::normals empty. */
  bool normals = true;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief What extractSurface() looked at. */
struct MarchingCubesStatistics {
  std::size_t corners = 0;       ///< positions at which the function was evaluated
  std::size_t cells = 0;         ///< cells that the surface crosses
  std::size_t skipped_cells = 0; ///< cells left out because the function is not defined at a corner
};

/** \brief Triangles of the zero set of a function, with shared vertices and normals along the gradient.
 *
 * Follows the surface from cell to cell, beginning at the cells of the seeds, so that time and memory are proportional
 * to the surface: about 250 bytes a crossed cell. Parts of the zero set that no seed's part is connected with are not
 * found. Cells with an undefined corner are left out: the surface ends where its support does.
 *
 * Faces of cells with two corners of each sign, opposite each other, are joined as the bilinear function of the four
 * corners is (the asymptotic decider of Nielson and Hamann, 1991), which both cells see alike, and polygons are cut
 * only by diagonals within the cell. So every edge has two triangles of opposite direction, or one at the border of the
 * domain. A corner with f = 0 counts as inside.
 * \param[in] function evaluated in batches from the calling thread
 * \param[in] seeds positions on or near the surface; a cell of them counts if the surface crosses it
 * \return mesh in an order that depends neither on threads nor on the order of the seeds
 * \throws InvalidParameter, ExcessiveWork naming the memory, Cancelled
 */
PCL_GPF_CORE_EXPORT SurfaceMesh
extractSurface(const MarchingCubesParameters& parameters,
               const ImplicitFunction& function,
               PointsView seeds,
               const ProgressCallback& progress = {},
               MarchingCubesStatistics* statistics = nullptr);

/** \brief Bytes that extractSurface() takes at most for a surface of this area, roughly. */
PCL_GPF_CORE_EXPORT double
estimateSurfaceMemory(double area, double cell_size);

} // namespace pcl_gpf
