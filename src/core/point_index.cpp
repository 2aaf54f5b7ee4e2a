// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>

#include "compact_order.h"
#include "sorted_points.h"

#include <algorithm>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 65536;

} // namespace

PointIndex::PointIndex(PointsView points, unsigned number_of_threads)
{
  checkPointCount(points.size);
  const std::size_t threads = resolveThreads(number_of_threads);
  order_ = compactOrder(points, threads);
  positions_ = SoaBuffer(size() + kQueryBlock);
  const auto one = [&](const float* from, AlignedArray<float>& to) {
    parallelBlocks(size(), kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        to[k] = from[order_[k]];
    });
    std::fill(to.begin() + size(), to.end(), kFarAway);
  };
  one(points.x, positions_.x);
  one(points.y, positions_.y);
  one(points.z, positions_.z);
  tree_.fit(sorted(), threads);
}

} // namespace pcl_gpf
