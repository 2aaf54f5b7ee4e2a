// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Order of points along a Hilbert curve through their bounding box, as indices; ties keep index order.
 *
 * Consecutive points are near each other, so that runs of them are small patches of the surface. Cost: O(N), one radix sort.
 */
PCL_GPF_CORE_EXPORT std::vector<std::uint32_t>
hilbertOrder(PointsView points, std::size_t threads);

/** \brief Axis-aligned box in float; empty when min > max. */
struct FloatBox {
  std::array<float, 3> min;
  std::array<float, 3> max;
};

/** \brief Boxes of the 8 children of one node, structure of arrays so that one comparison tests all; those that are not there are
 * empty. */
struct BoxPack {
  static constexpr std::size_t kBoxes = 8;
  float min[3][kBoxes];
  float max[3][kBoxes];
};

/** \brief Consecutive points [begin, end) of a sorted array. */
struct Run {
  std::uint32_t begin;
  std::uint32_t end;
};

/** \brief Bounding boxes over points in Hilbert order: clusters of 8 points, and an implicit tree of 8 children above them.
 *
 * Plays the part of a uniform grid in the fixed-radius sums, without its weak spots: no cell size to choose, no memory for empty
 * space however far an outlier lies, short candidate lists on uneven density; and fit() follows points that move without sorting.
 * Memory: about 4 bytes a point. Queries are const and may run concurrently.
 */
class PCL_GPF_CORE_EXPORT ClusterTree {
public:
  static constexpr std::size_t kClusterSize = 8;
  static constexpr std::size_t kFanout = BoxPack::kBoxes;

  /** \brief Computes all boxes from positions in sorted order. Positions may have been moved since they were sorted: results stay
   * exact, only candidate lists grow. With `radii` (one a point) the boxes enclose balls: collectRuns() with radius 0 then finds
   * every ball that meets the box, and nearest() must not be used. */
  void
  fit(PointsView sorted, std::size_t threads, const float* radii = nullptr);

  /** \brief Appends the runs of points whose cluster boxes come within `radius` of `box`, ascending, adjacent runs merged. */
  void
  collectRuns(const FloatBox& box, float radius, std::vector<Run>& runs) const;

  /** \brief Groups of 8 clusters whose boxes come within `radius` of `box`, ascending: where collectRuns() may begin for boxes
   * inside this one. */
  void
  collectGroups(const FloatBox& box, float radius, std::vector<std::uint32_t>& groups) const;

  /** \brief The same runs found among `groups`. */
  void
  collectRuns(const std::vector<std::uint32_t>& groups, const FloatBox& box, float radius, std::vector<Run>& runs) const;

  /** \brief Squared distances of the k nearest points of `sorted` (as given to fit()) to a position, ascending; fewer if the
   * tree has fewer points. `indices`, when not null, receives their sorted positions. Ties: any. */
  void
  nearest(PointsView sorted,
          const std::array<float, 3>& query,
          std::size_t k,
          std::vector<float>& distances_sq,
          std::vector<std::uint32_t>* indices = nullptr) const;

  std::size_t
  size() const
  {
    return size_;
  }
  /** \brief Box of all points. */
  FloatBox
  bounds() const;

private:
  using Level = std::vector<BoxPack>;

  std::vector<Level> levels_; ///< levels_[0]: boxes of clusters; the last level has one pack
  std::size_t size_ = 0;
};

} // namespace pcl_gpf
