// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>

#include <pcl/common/copy_point.h>
#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <limits>

namespace pcl_gpf {

/** \brief Parameters of estimateNormals(). */
struct NormalEstimationParameters {
  /** Number of nearest neighbours k >= 3 whose plane gives the normal, the point itself included; not used when
   * `radius` is set. Few: noisy normals. Many: edges become round. */
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

/** \brief Gives every finite point of a cloud a normal and, where the type has it, a curvature, by
 * pcl::NormalEstimationOMP.
 *
 * All other fields, the order and the organisation stay. Points that are not finite, or have too few neighbours for a
 * plane, get a NaN normal. is_dense is set by fact. Normals point towards the cloud's sensor origin.
 * Cost: one k-d tree and one query a point.
 * \return number of points that have no normal
 * \throws pcl::BadArgumentException if a parameter is out of its range
 * \note A viewpoint orients one scan; a cloud merged from several, or a closed surface seen from inside its box, gets
 * signs that are not consistent. BilateralNormalFilter (by default) and GPF do not need consistent signs.
 */
template <typename PointT> std::size_t
estimateNormals(pcl::PointCloud<PointT>& cloud, const NormalEstimationParameters& parameters = {})
{
  // A separate cloud of the finite points, about the first of them: PCL then sees a dense cloud (its own output flag
  // would turn off its test of the input when both are one cloud), and large coordinates cost no digits.
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  std::vector<std::size_t> places;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!pcl::isXYZFinite(cloud[i]))
      continue;
    const Eigen::Vector3f position(cloud[i].x, cloud[i].y, cloud[i].z);
    if (places.empty())
      centre = position;
    const Eigen::Vector3f shifted = position - centre;
    points->push_back(pcl::PointXYZ(shifted.x(), shifted.y(), shifted.z()));
    places.push_back(i);
  }
  const Eigen::Vector3f viewpoint = cloud.sensor_origin_.template head<3>() - centre;
  const pcl::PointCloud<pcl::Normal> normals = estimateNormalsOfFinitePoints(points, viewpoint, parameters);

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
