// SPDX-License-Identifier: BSD-3-Clause
#include "steered_ellipsoids.h"

namespace pcl_gpf {

namespace {

/** Rounding of the least eigenvalue must not cost a pair. */
constexpr float kReachSlack = 1.01f;

} // namespace

SteeredEllipsoids
steeredEllipsoids(const SteeredFitParameters& p, const NormalTensors& tensors, const std::vector<std::uint32_t>& queries)
{
  const double longest = p.longest_share * p.radius;
  const auto round = static_cast<float>(1.0 / (longest * longest));
  const auto bend = static_cast<float>(p.bending_weight / (p.radius * p.radius));
  SteeredEllipsoids metrics{SortedVectors<float>(queries.size()), SortedVectors<float>(queries.size()), AlignedArray<float>(queries.size() + kQueryBlock)};
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const NormalTensor& t = tensors.of(queries[q]);
    metrics.diagonal.x[q] = round + bend * t.xx;
    metrics.diagonal.y[q] = round + bend * t.yy;
    metrics.diagonal.z[q] = round + bend * t.zz;
    metrics.mixed.x[q] = bend * t.yz;
    metrics.mixed.y[q] = bend * t.xz;
    metrics.mixed.z[q] = bend * t.xy;
    metrics.reach_sq[q] = kReachSlack / (round + bend * t.least);
  }
  return metrics;
}

} // namespace pcl_gpf
