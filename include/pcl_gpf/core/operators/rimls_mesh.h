// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/marching_cubes.h>
#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/surface_mesh.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief Parameters of the RIMLS surface mesh. Lengths are in the unit of the points they are used with. */
struct RimlsMeshParameters {
  /** The implicit surface. Where cells are wide against the points, local radii are raised and the scale is lowered, so
   * that the support reaches about 4 cells at least: there is nothing to resolve below. Default scale 6, not 4: at a
   * corner of unevenly sampled faces a small support may see one face only and go on beyond it. */
  RimlsParameters rimls = defaultRimls();

  /** Cells along the longest side of the box of the points (outliers left out), 2 .. 65536. Time and
   * memory grow with its square. */
  unsigned resolution = 200;

  /** Edge of a cell instead, >= 0; 0 = from `resolution`. */
  double cell_size = 0.0;

  /** Move the vertices from the straight edges of the cells onto the surface; smoother, and sharper at edges. */
  bool project_vertices = true;

  /** Connected parts with fewer triangles than this share of the largest one's are removed, 0 .. 1. */
  double smallest_component = 0.01;

  /** Holes of at most so many edges are closed, 0 .. 1000; 0 = none. They appear where the surface leaves its domain
   * for a few cells. */
  unsigned largest_hole = 30;

  /** Bytes that lattice and mesh may take, >= 1. */
  std::size_t memory_limit = std::size_t{2} << 30;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;

private:
  static RimlsParameters
  defaultRimls()
  {
    RimlsParameters rimls;
    rimls.scale = 6.0;
    return rimls;
  }
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const RimlsMeshParameters& parameters);

/** \brief What meshRimls() did; lengths in the unit of the points. */
struct RimlsMeshStatistics {
  double cell_size = 0;
  double spacing = 0;            ///< of the points
  double support_radius = 0;     ///< median h_i
  double expected_memory = 0;    ///< bytes, estimated before the work starts
  MarchingCubesStatistics cells;
  std::size_t removed_components = 0;
  std::size_t filled_holes = 0;
  double mean_vertex_movement = 0; ///< of the projection
  double seconds = 0;
};

/** \brief The checks of memory and work that meshRimls() does, alone.
 * \param[in] points N finite positions in the normalised frame
 * \return bytes that lattice and mesh will take, estimated
 * \throws InvalidParameter, UnsuitableData, ExcessiveWork as meshRimls() does */
PCL_GPF_CORE_EXPORT double
checkMeshMemory(const RimlsMeshParameters& parameters, PointsView points);

/** \brief Mesh of the RIMLS surface of points with consistently oriented normals.
 *
 * Closed where the points are; elsewhere it ends about two local radii beyond them. Counterclockwise faces look along
 * the normals.
 * \param[in] points N finite positions in the normalised frame \param[in] normals N unit vectors
 * \throws InvalidParameter, UnsuitableData (fewer than 4 points, all in one place or on one line), ExcessiveWork naming the
 * memory that the resolution takes, or the pairs and seconds of a support radius that holds too many points, before the
 * work starts, Cancelled
 */
PCL_GPF_CORE_EXPORT SurfaceMesh
meshRimls(const RimlsMeshParameters& parameters,
          PointsView points,
          NormalsView normals,
          const ProgressCallback& progress = {},
          RimlsMeshStatistics* statistics = nullptr);

} // namespace pcl_gpf
