// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/local_frame.h>

#include <pcl/common/copy_point.h>
#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl_gpf {

/** \brief Parameters of estimateNormals(). */
struct NormalEstimationParameters {
  /** Number of nearest neighbours k >= 3 whose plane gives the normal, the point itself included; not used when
   * `radius` is set; more than there are points count as all of them. Few: noisy normals. Many: edges become round. */
  unsigned neighbors = 30;
  /** Radius of the neighbourhood in cloud units, >= 0; 0 = by `neighbors`. */
  double radius = 0.0;
  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Normals and curvatures of finite points by pcl::NormalEstimationOMP, turned towards `viewpoint`; NaN where no
 * plane fits.
 *
 * \param[in] points not null, finite positions
 * \param[in] viewpoint in the frame of the points
 * \throws pcl::BadArgumentException
 */
PCL_GPF_EXPORT pcl::PointCloud<pcl::Normal>
estimateNormalsOfFinitePoints(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points,
                              const Eigen::Vector3f& viewpoint,
                              const NormalEstimationParameters& parameters);

namespace detail {

/** \brief The same in the unit of the frame; a radius stays one, however small or large. */
PCL_GPF_EXPORT NormalEstimationParameters
inFrame(NormalEstimationParameters parameters, const LocalFrame& frame);

/** \brief Frame of the dense part of the finite points, in which its box has diagonal 1. */
template <typename PointT> LocalFrame
denseFrame(const pcl::PointCloud<PointT>& cloud)
{
  std::vector<std::size_t> finite;
  BoundingBox box;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (pcl::isXYZFinite(cloud[i])) {
      finite.push_back(i);
      box.add(cloud[i].x, cloud[i].y, cloud[i].z);
    }
  return localFrame(denseBox(box, finite.size(), [&](std::size_t k, std::size_t axis) { return double{cloud[finite[k]].data[axis]}; }));
}

/** \brief The points in a frame, as far as floats hold the squares of their coordinates there. \param[out] places of these points */
template <typename PointT> pcl::PointCloud<pcl::PointXYZ>::Ptr
pointsInFrame(const pcl::PointCloud<PointT>& cloud, const LocalFrame& frame, std::vector<std::size_t>& places)
{
  constexpr float kFarthest = 1e15f;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const pcl::PointXYZ point(frame.toLocal(cloud[i].x, 0), frame.toLocal(cloud[i].y, 1), frame.toLocal(cloud[i].z, 2));
    if (!(std::abs(point.x) < kFarthest && std::abs(point.y) < kFarthest && std::abs(point.z) < kFarthest))
      continue;
    points->push_back(point);
    places.push_back(i);
  }
  return points;
}

} // namespace detail

/** \brief Gives every finite point of a cloud a normal and, where the type has it, a curvature, by
 * pcl::NormalEstimationOMP.
 *
 * All other fields, the order and the organisation stay. Points that are not finite, or have too few neighbours for a
 * plane, get a NaN normal, and so do those that lie 1e15 extents of the others away from them. is_dense is set by fact.
 * Normals point towards the cloud's sensor origin.
 * Cost: one k-d tree and one query a point.
 * \return number of points that have no normal
 * \throws pcl::BadArgumentException if a parameter is out of its range
 * \note A viewpoint orients one scan; a cloud merged from several, or a closed surface seen from inside its box, gets
 * signs that are not consistent. BilateralNormalFilter (by default) and GPF do not need consistent signs.
 */
template <typename PointT> std::size_t
estimateNormals(pcl::PointCloud<PointT>& cloud, const NormalEstimationParameters& parameters = {})
{
  // A separate cloud of the finite points, about the middle of their dense part and in units of it: PCL then sees a dense cloud (its own
  // output flag would turn off its test of the input when both are one cloud), and coordinates of any size cost no digits.
  std::vector<std::size_t> places;
  const LocalFrame frame = detail::denseFrame(cloud);
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points = detail::pointsInFrame(cloud, frame, places);
  const auto& origin = cloud.sensor_origin_;
  const Eigen::Vector3f viewpoint(frame.toLocal(origin[0], 0), frame.toLocal(origin[1], 1), frame.toLocal(origin[2], 2));
  const pcl::PointCloud<pcl::Normal> normals = estimateNormalsOfFinitePoints(points, viewpoint, detail::inFrame(parameters, frame));

  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  pcl::Normal none(kNaN, kNaN, kNaN, kNaN);
  std::size_t next = 0;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool finite = next < places.size() && places[next] == i;
    const pcl::Normal& normal = finite ? normals[next++] : none;
    missing += !pcl::isNormalFinite(normal);
    pcl::copyPoint(normal, cloud[i]);
  }
  cloud.is_dense = missing == 0;
  return missing;
}

} // namespace pcl_gpf
