// SPDX-License-Identifier: BSD-3-Clause
#include "pooled_misfit.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>

#include "../neighborhoods.h"

namespace pcl_gpf {

std::vector<double>
poolMisfits(const SortedVectors<float>& places, const std::vector<double>& misfits, double most, double radius, std::size_t threads)
{
  const std::size_t count = misfits.size(), padded = count + kQueryBlock;
  AlignedArray<float> counted(padded), misfit(padded), in_ball(padded), weight(padded), sum(padded), number(padded);
  for (std::size_t q = 0; q < count; ++q)
    if (misfits[q] <= most) {
      counted[q] = 1.0f;
      misfit[q] = static_cast<float>(misfits[q]);
    }
  const PointsView view = {places.x.data(), places.y.data(), places.z.data(), count};
  ClusterTree tree;
  tree.fit(view, threads);
  const Neighborhoods near = findNeighborhoods(tree, view, radius, threads);
  kernels::FieldSums a;
  a.data = a.queries = places.vectors();
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.first_field = misfit.data();
  a.second_field = counted.data();
  a.count = in_ball.data();
  a.weight_sum = weight.data();
  a.first_sum = sum.data();
  a.second_sum = number.data();
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(count), kBlocksPerTask, threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
  std::vector<double> pooled = misfits;
  for (std::size_t q = 0; q < count; ++q)
    if (counted[q] > 0.0f)
      pooled[q] = static_cast<double>(sum[q]) / static_cast<double>(number[q]);
  return pooled;
}

} // namespace pcl_gpf
