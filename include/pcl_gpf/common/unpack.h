// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/core/views.h>

#include <pcl/point_cloud.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_gpf {

/** \brief Which points a filter keeps and where they are now. */
struct FilteredPoints {
  std::vector<std::uint32_t> kept; ///< positions in PackedCloud::chosen, one for each output point, in output order
  std::vector<std::uint32_t> rows; ///< M: the packed row of each kept point that is usable, in the same order
  SoaBuffer displacements;         ///< M, normalised frame
  SoaBuffer normals;               ///< M, unit length
};

namespace detail {

/** \brief A finite coordinate as the nearest finite float. */
inline float
finiteFloat(double coordinate)
{
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(coordinate, -kLargest, kLargest));
}

/** \brief A coordinate plus its displacement, finite; one that nothing moved keeps its last bit. */
inline float
moved(float seed, float displacement, double scale)
{
  return displacement == 0.0f ? seed // adding 0 would turn -0 into 0
                              : finiteFloat(static_cast<double>(seed) + static_cast<double>(displacement) * scale);
}

template <typename PointT> void
makeHole(PointT& point)
{
  point.x = point.y = point.z = std::numeric_limits<float>::quiet_NaN();
  point.normal_x = point.normal_y = point.normal_z = std::numeric_limits<float>::quiet_NaN();
}

} // namespace detail

/** \brief Writes output points: each is its seed point as a whole, then position and normal are replaced.
 *
 * Kept points without a normal are copied as they are; kept points that are not finite become holes: NaN in position
 * and normal.
 * \param[out] output has filtered.kept.size() points already; is_dense is set by fact
 */
template <typename PointT> void
unpack(const pcl::PointCloud<PointT>& input,
       const PackedCloud& packed,
       const FilteredPoints& filtered,
       pcl::PointCloud<PointT>& output)
{
  std::size_t next = 0;
  output.is_dense = true;
  for (std::size_t i = 0; i < filtered.kept.size(); ++i) {
    const std::size_t position = filtered.kept[i];
    PointT& point = output[i];
    point = input[static_cast<std::size_t>(packed.chosen[position])];
    if (packed.states[position] == PointState::NonFinite)
      detail::makeHole(point);
    else if (packed.states[position] == PointState::Usable) {
      point.x = detail::moved(point.x, filtered.displacements.x[next], packed.frame.scale);
      point.y = detail::moved(point.y, filtered.displacements.y[next], packed.frame.scale);
      point.z = detail::moved(point.z, filtered.displacements.z[next], packed.frame.scale);
      point.normal_x = filtered.normals.x[next];
      point.normal_y = filtered.normals.y[next];
      point.normal_z = filtered.normals.z[next];
      ++next;
    }
    output.is_dense = output.is_dense && pcl::isXYZFinite(point) && pcl::isNormalFinite(point);
  }
}

} // namespace pcl_gpf
