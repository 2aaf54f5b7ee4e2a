// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/surface_mesh.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Parameters of the screened Poisson surface (Kazhdan, Hoppe, ACM TOG 2013) as PCL computes it. */
struct PoissonMeshParameters {
  /** Depth of the octree, 2 .. 12: 2^depth cells along the box, which is a tenth larger than that of the points. Each level takes
   * about four times the time and memory. */
  unsigned depth = 8;

  /** Weight of the points against the normals, 0 .. 1000; 0 = not screened. */
  double point_weight = 4.0;

  /** Fewest samples in a leaf, 1 .. 20: more for noise. */
  double samples_per_node = 1.5;

  /** Triangles farther than this many spacings from every point are left out, >= 0; 0 = keep the closed surface, with what the method
   * invents where there are no points. */
  double trim = 8.0;

  /** Connected parts with fewer triangles than this share of the largest one's are removed, 0 .. 1. */
  double smallest_component = 0.01;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_EXPORT void
validate(const PoissonMeshParameters& parameters);

/** \brief Mesh of pcl::Poisson with shared vertices, normals from the faces and faces that look along the points' normals.
 *
 * \param[in] points N finite positions in the normalised frame \param[in] normals N unit vectors, consistently oriented
 * \throws InvalidParameter, UnsuitableData for fewer than 4 points or points in one place
 * \note PCL's code can neither be cancelled nor tell its progress. It uses one thread.
 */
PCL_GPF_EXPORT SurfaceMesh
meshPoisson(const PoissonMeshParameters& parameters, PointsView points, NormalsView normals, unsigned number_of_threads = 0);

} // namespace pcl_gpf
