// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/local_noise.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "filtered_cloud_index.h"

#include <cmath>

namespace pcl_gpf {

namespace {

/** Normals that deviate by this angle belong to other faces. */
constexpr double kFaceAngle = 0.52359877559829887308; // 30 degrees

} // namespace

std::vector<float>
localNoise(const LocalNoiseParameters& p, PointsView filtered, NormalsView normals, const float* moves, const float* weights)
{
  checkRange("radius", p.radius, p.radius > 0.0, "> 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  std::vector<float> sigma(filtered.size);
  if (filtered.size == 0)
    return sigma;
  const double radius = boundedRadius(p.radius);
  const FilteredCloudIndex cloud(filtered, normals, radius, p.spacing, p.number_of_threads);
  AlignedArray<float> squares(cloud.data.size() + kQueryBlock), shares(cloud.data.size() + kQueryBlock);
  for (std::size_t k = 0; k < cloud.data.size(); ++k) {
    const std::uint32_t source = cloud.source(k);
    shares[k] = weights ? weights[source] : 1.0f;
    squares[k] = shares[k] * moves[source] * moves[source];
  }
  AlignedArray<float> count(filtered.size + kQueryBlock), weight(filtered.size + kQueryBlock), square_sum(filtered.size + kQueryBlock),
      share_sum(filtered.size + kQueryBlock);
  kernels::FieldSums a = cloud.sums(radius, kFaceAngle);
  a.first_field = squares.data();
  a.second_field = shares.data();
  a.count = count.data();
  a.weight_sum = weight.data();
  a.first_sum = square_sum.data();
  a.second_sum = share_sum.data();
  const Neighborhoods near = cloud.neighborhoods(radius);
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(filtered.size), kBlocksPerTask, cloud.threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
  for (std::size_t k = 0; k < filtered.size; ++k)
    if (share_sum[k] > 0.0f)
      sigma[cloud.points.order()[k]] = std::sqrt(square_sum[k] / share_sum[k]);
  return sigma;
}

} // namespace pcl_gpf
