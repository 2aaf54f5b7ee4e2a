// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sorted_points.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/point_index.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Radius of the balls that are summed over, normalised frame: one for all, or its square for every sorted point. */
struct BallRadius {
  double radius = 0.0;
  const float* per_point_sq = nullptr;
};

/** \brief Means that stand for several points each in sums over balls that hold many.
 *
 * A mean is taken of 2, 4, 8, ... consecutive sorted points, so many that a ball still holds more than half of
 * `merge_above` of them, counted anew for every 1,024 points; no wider than kWidestShare of the radius; and only of
 * points whose normals deviate by no more than about 15 degrees. Where a ball holds no more than `merge_above` points
 * every point is its own mean, to the last bit. Does not depend on the number of threads. Memory: 28 bytes a mean and 4
 * a point.
 */
struct MergedPoints {
  static constexpr std::size_t kLargestGroup = 256; ///< points of one mean
  /** Diagonal of the box about the points of a mean, as a share of the radius. */
  static constexpr double kWidestShare = 0.45;
  /** Least cosine of a point's normal with that of the first point of its mean. */
  static constexpr float kSameDirection = 0.966f;

  SortedVectors<float> positions;
  SortedVectors<float> normals;  ///< of unit length; empty when merged without
  AlignedArray<float> weights;   ///< number of points that each stands for
  std::vector<std::uint32_t> mean_of; ///< of each sorted point; empty when not wanted
  ClusterTree tree;

  bool empty() const { return weights.empty(); }
  std::size_t size() const { return positions.size(); }
  PointsView view() const { return {positions.x.data(), positions.y.data(), positions.z.data(), size()}; }
};

/** \brief Merges the points of an index; empty when that would leave more than three quarters of them and no ball holds a
 * pile, 16 times as many as `merge_above` or so.
 * \param[in] normals unit vectors in sorted order, of free sign; null pointers: positions alone decide
 * \param[in] merge_above a ball that holds more points is thinned out; 0 = never
 */
MergedPoints
mergePoints(const PointIndex& points, VectorsView normals, const BallRadius& radius, unsigned merge_above,
            bool want_mean_of, std::size_t threads);

} // namespace pcl_gpf
