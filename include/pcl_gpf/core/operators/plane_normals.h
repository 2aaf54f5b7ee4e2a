// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief Parameters of the plane fit (principal component analysis) that gives first normals. */
struct PlaneNormalsParameters {
  /** Radius of the neighbourhood in the unit of the points, >= 0; 0 = estimated. Points with fewer than 6 neighbours in it, or
   * only those of one scan line, get the plane of their 12, 32 or 96 nearest, the first of these that is not a line. */
  double radius = 0.0;
  /** Where a ball holds more points than this, means of neighbouring points stand for them, at least half as many as this;
   * 0 = never. */
  unsigned merge_above = 200;
  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const PlaneNormalsParameters& parameters);

/** \brief Least-squares plane normal of every point: eigenvector of the least eigenvalue of its neighbourhood's covariance.
 *
 * Signs: the component of largest magnitude is positive, so they are repeatable but not consistent over a surface.
 * \param[in] points N finite positions, normalised frame
 * \param[out] normals N unit vectors
 * \param[out] surface_variation N values lambda_0 / (lambda_0 + lambda_1 + lambda_2) (PCL's curvature), or null
 * \return number of points whose neighbourhood spans no plane; they get the normal (0, 0, 1)
 * \throws InvalidParameter if radius <= 0, ExcessiveWork
 */
PCL_GPF_CORE_EXPORT std::size_t
estimatePlaneNormals(const PlaneNormalsParameters& parameters,
                     PointsView points,
                     MutableVectorsView normals,
                     float* surface_variation = nullptr);

/** \brief The same on points that are sorted already; results in sorted order. */
PCL_GPF_CORE_EXPORT std::size_t
estimatePlaneNormals(const PlaneNormalsParameters& parameters,
                     const PointIndex& points,
                     MutableVectorsView normals,
                     float* surface_variation = nullptr);

} // namespace pcl_gpf
