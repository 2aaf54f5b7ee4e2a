// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Which points of the fitted surfaces are put out. */
enum class MLSMethod {
  None,                ///< each input point, moved onto its surface
  SampleLocalPlane,    ///< a disc of points about each input point, `upsampling_step` apart; discs overlap
  RandomUniformDensity, ///< as many random points about each as the density of its neighbourhood lacks
  VoxelGridDilation    ///< one point for each voxel on the surface, holes of a few voxels filled; even, and the usual choice
};

/** \brief Parameters of MLSUpsampling; lengths 0 are estimated from the spacing of the cloud. */
struct MLSUpsamplingParameters {
  MLSMethod method = MLSMethod::VoxelGridDilation;
  /** Radius of the neighbourhood that a polynomial is fitted to, >= 0; 0 = 4 spacings. Small: noise stays and points with fewer
   * than 3 neighbours are dropped. Large: details and edges round off. */
  double radius = 0.0;
  /** Degree of the polynomial, 0 .. 5; below 2 a plane. High degrees follow noise. */
  unsigned order = 2;
  /** SampleLocalPlane: radius of the disc, >= 0; 0 = 1 spacing. */
  double upsampling_radius = 0.0;
  /** SampleLocalPlane: distance of the points on the disc, >= 0; 0 = half a spacing. */
  double upsampling_step = 0.0;
  /** RandomUniformDensity: points wanted within `radius`, >= 0; 0 = for about twice as many as there are. Each gives way to
   * density / 2 / neighbours points, rounded down, at least itself. */
  double density = 0.0;
  /** VoxelGridDilation: side of the voxels, >= 0; 0 = 1 spacing. */
  double voxel_size = 0.0;
  /** VoxelGridDilation: rounds in which the voxels grow, 0 .. 16; closes holes, and widens borders by as many voxels. */
  unsigned dilation_iterations = 1;
  /** Seed of the random mode. */
  std::uint64_t seed = 1;
  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_EXPORT void
validate(const MLSUpsamplingParameters& parameters);

/** \brief Points on fitted surfaces, ascending by source. */
struct MLSPoints {
  pcl::PointCloud<pcl::PointNormal> points; ///< with unit normals of arbitrary sign, and curvature
  std::vector<std::uint32_t> sources;       ///< the input point whose surface each lies on
  std::vector<std::uint32_t> dropped;       ///< input points without a surface, ascending
  double radius = 0;                        ///< that was used
};

/** \brief Upsamples finite points by pcl::MovingLeastSquares; the part of MLSUpsampling that does not depend on the point type.
 *
 * \param[in] points at least 3, finite, best with the origin in their middle
 * \throws InvalidParameter, UnsuitableData, ExcessiveWork
 */
PCL_GPF_EXPORT MLSPoints
upsampleByMls(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points, const MLSUpsamplingParameters& parameters);

} // namespace pcl_gpf
