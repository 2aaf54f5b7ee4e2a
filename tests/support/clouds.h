// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pcl_gpf::test {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/** \brief Fills the fields that a filter must carry along with values that tell the point's number. */
inline void
setForeignFields(pcl::PointNormal& point, std::size_t i)
{
  point.curvature = static_cast<float>(i) + 0.5f;
}
inline void
setForeignFields(pcl::PointXYZRGBNormal& point, std::size_t i)
{
  point.curvature = static_cast<float>(i) + 0.5f;
  point.rgba = 0x11000000u + static_cast<std::uint32_t>(i);
}
inline void
setForeignFields(pcl::PointXYZINormal& point, std::size_t i)
{
  point.curvature = static_cast<float>(i) + 0.5f;
  point.intensity = static_cast<float>(2 * i);
}

/** \brief Number of the point that setForeignFields() was called with, or -1 if the fields disagree. */
inline int
numberOf(const pcl::PointNormal& point)
{
  return static_cast<int>(point.curvature);
}
inline int
numberOf(const pcl::PointXYZRGBNormal& point)
{
  const int number = static_cast<int>(point.rgba) - 0x11000000;
  return static_cast<int>(point.curvature) == number ? number : -1;
}
inline int
numberOf(const pcl::PointXYZINormal& point)
{
  const int number = static_cast<int>(point.intensity) / 2;
  return static_cast<int>(point.curvature) == number ? number : -1;
}

template <typename PointT> typename pcl::PointCloud<PointT>::Ptr
toCloud(const Shape& shape, double scale = 1, const Vector3& offset = {0, 0, 0})
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    PointT point;
    point.x = static_cast<float>(scale * shape.points[i][0] + offset[0]);
    point.y = static_cast<float>(scale * shape.points[i][1] + offset[1]);
    point.z = static_cast<float>(scale * shape.points[i][2] + offset[2]);
    point.normal_x = static_cast<float>(shape.normals[i][0]);
    point.normal_y = static_cast<float>(shape.normals[i][1]);
    point.normal_z = static_cast<float>(shape.normals[i][2]);
    setForeignFields(point, i);
    cloud->push_back(point);
  }
  return cloud;
}

template <typename PointT> Vector3
position(const PointT& point)
{
  return {point.x, point.y, point.z};
}

template <typename PointT> Vector3
normal(const PointT& point)
{
  return {point.normal_x, point.normal_y, point.normal_z};
}

inline double
distance(const Vector3& a, const Vector3& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** \brief Same bits in position and normal, NaN included. */
template <typename PointT> bool
sameBits(const PointT& a, const PointT& b)
{
  return std::memcmp(a.data, b.data, 3 * sizeof(float)) == 0 && std::memcmp(a.normal, b.normal, 3 * sizeof(float)) == 0;
}

template <typename PointT> bool
sameBits(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b)
{
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!sameBits(a[i], b[i]))
      return false;
  return true;
}

/** \brief Largest distance between points of the same place in two clouds; infinite if sizes differ. */
template <typename PointT> double
largestDistance(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b)
{
  if (a.size() != b.size())
    return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::fmax(largest, distance(position(a[i]), position(b[i])));
  return largest;
}

/** \brief Largest distance between normals of the same place, up to sign; infinite if sizes differ. */
template <typename PointT> double
largestTurn(const pcl::PointCloud<PointT>& a, const pcl::PointCloud<PointT>& b)
{
  if (a.size() != b.size())
    return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector3 n = normal(b[i]);
    const double turn = std::fmin(distance(normal(a[i]), n), distance(normal(a[i]), {-n[0], -n[1], -n[2]}));
    largest = std::fmax(largest, turn);
  }
  return largest;
}

} // namespace pcl_gpf::test
