// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Normals shorter than this have no direction; a constant, since normals have no unit. */
constexpr double kShortestNormal = 1e-6;

/** \brief What a filter can do with a point. */
enum class PointState : std::uint8_t {
  Usable,        ///< finite position and a normal with a direction
  WithoutNormal, ///< finite position, but the normal is NaN, infinite or zero
  NonFinite      ///< a coordinate is NaN or infinite
};

/** \brief The chosen points of a cloud, the usable ones as the core wants them. */
struct PackedCloud {
  pcl::Indices chosen;            ///< S different cloud indices, in the order of their first appearance
  std::vector<PointState> states; ///< of each of them
  std::size_t points_without_normal = 0;
  std::size_t non_finite_points = 0;
  bool all_identical = false; ///< the usable points coincide, or there are none
  LocalFrame frame;           ///< of the bounding box of the usable points
  SoaBuffer points;           ///< N usable points in the order of `chosen`, normalised frame
  SoaBuffer normals;          ///< their normals, unit length

  std::size_t size() const { return points.size(); } ///< N
};

/** \brief State of one point. */
template <typename PointT> PointState
pointState(const PointT& point)
{
  if (!pcl::isXYZFinite(point))
    return PointState::NonFinite;
  const double length = std::hypot(static_cast<double>(point.normal_x), point.normal_y, point.normal_z);
  return std::isfinite(length) && length >= kShortestNormal ? PointState::Usable : PointState::WithoutNormal;
}

namespace detail {

/** \brief Sorts the points of `indices` out; an index that appears twice counts once. \throws InvalidParameter */
template <typename PointT> PackedCloud
chooseAndBox(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices, BoundingBox& box)
{
  PackedCloud packed;
  packed.chosen.reserve(indices.size());
  packed.states.reserve(indices.size());
  std::vector<bool> seen(cloud.size(), false);
  for (const pcl::index_t index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= cloud.size())
      throw InvalidParameter("the indices contain " + std::to_string(index) + ", but the cloud has " +
                             std::to_string(cloud.size()) + " points");
    const auto position = static_cast<std::size_t>(index);
    if (seen[position])
      continue;
    seen[position] = true;
    const PointT& point = cloud[position];
    const PointState state = pointState(point);
    packed.chosen.push_back(index);
    packed.states.push_back(state);
    packed.points_without_normal += state == PointState::WithoutNormal;
    packed.non_finite_points += state == PointState::NonFinite;
    if (state == PointState::Usable)
      box.add(point.x, point.y, point.z);
  }
  return packed;
}

/** Box of the dense part of the usable points. \throws UnsuitableData where one of them hides the others (refuseFarPoint()) */
template <typename PointT>
BoundingBox
denseBoxOf(const pcl::PointCloud<PointT>& cloud, const PackedCloud& packed, const BoundingBox& box)
{
  std::vector<pcl::index_t> usable;
  usable.reserve(box.count);
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] == PointState::Usable)
      usable.push_back(packed.chosen[i]);
  const auto coordinate = [&](std::size_t k, std::size_t axis) {
    const PointT& point = cloud[static_cast<std::size_t>(usable[k])];
    return static_cast<double>(point.data[axis]);
  };
  const BoundingBox dense = denseBox(box, usable.size(), coordinate);
  refuseFarPoint(box, dense, usable.size(), coordinate, [&](std::size_t k) { return "point " + std::to_string(usable[k]); });
  return dense;
}

} // namespace detail

/** \brief Copies the usable points of `indices` into structure-of-arrays form in the normalised frame.
 *
 * The box is found in double. O(size of the cloud) time, 24 bytes a usable point and 5 a chosen one.
 * \throws InvalidParameter if an index is out of range, UnsuitableData if one point lies so far away that the others cannot be told
 * apart, ExcessiveWork beyond 2^32 - 2 points (the core takes at most 2^31 - 17)
 */
template <typename PointT> PackedCloud
pack(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  BoundingBox box;
  PackedCloud packed = detail::chooseAndBox(cloud, indices, box);
  if (box.count >= std::numeric_limits<std::uint32_t>::max())
    throw ExcessiveWork(std::to_string(box.count) + " points are more than one run can index (2^32 - 2); filter in parts");
  packed.frame = localFrame(box, detail::denseBoxOf(cloud, packed, box));
  packed.all_identical = !(box.diagonal() > 0);
  packed.points = SoaBuffer(box.count);
  packed.normals = SoaBuffer(box.count);
  std::size_t row = 0;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i) {
    if (packed.states[i] != PointState::Usable)
      continue;
    const PointT& point = cloud[static_cast<std::size_t>(packed.chosen[i])];
    packed.points.x[row] = packed.frame.toLocal(point.x, 0);
    packed.points.y[row] = packed.frame.toLocal(point.y, 1);
    packed.points.z[row] = packed.frame.toLocal(point.z, 2);
    const double length = std::hypot(static_cast<double>(point.normal_x), point.normal_y, point.normal_z);
    packed.normals.x[row] = static_cast<float>(point.normal_x / length);
    packed.normals.y[row] = static_cast<float>(point.normal_y / length);
    packed.normals.z[row] = static_cast<float>(point.normal_z / length);
    ++row;
  }
  return packed;
}

/** \brief What rounding the packed points to float cut off; for recursions that run in double. 12 bytes a usable point.
 */
template <typename PointT> SoaBuffer
packRemainders(const pcl::PointCloud<PointT>& cloud, const PackedCloud& packed)
{
  SoaBuffer remainders(packed.size());
  const auto remainder = [&](float world, std::size_t axis, float local) {
    return static_cast<float>((world - packed.frame.origin[axis]) / packed.frame.scale - local);
  };
  std::size_t row = 0;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i) {
    if (packed.states[i] != PointState::Usable)
      continue;
    const PointT& point = cloud[static_cast<std::size_t>(packed.chosen[i])];
    remainders.x[row] = remainder(point.x, 0, packed.points.x[row]);
    remainders.y[row] = remainder(point.y, 1, packed.points.y[row]);
    remainders.z[row] = remainder(point.z, 2, packed.points.z[row]);
    ++row;
  }
  return remainders;
}

} // namespace pcl_gpf
