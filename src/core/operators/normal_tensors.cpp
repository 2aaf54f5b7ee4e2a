// SPDX-License-Identifier: BSD-3-Clause
#include "normal_tensors.h"

#include <pcl_gpf/core/parallel.h>

#include "../ball_count.h"
#include "../sorted_points.h"

#include <algorithm>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace pcl_gpf {

namespace {

/** Most points that a ball is to hold; more would only cost time. */
constexpr std::size_t kMostData = 96;
/** Balls that are counted to see how many they hold. */
constexpr std::size_t kCounted = 64;

/** Mean number of points in a ball, over a few of them. */
double
meanCount(PointsView points, const ClusterTree& tree, double radius)
{
  std::vector<Run> runs;
  const auto radius_sq = static_cast<float>(radius * radius);
  const std::size_t step = std::max<std::size_t>(1, points.size / kCounted);
  std::size_t balls = 0, held = 0;
  for (std::size_t i = step / 2; i < points.size; i += step, ++balls)
    held += countBall(tree, points, i, radius_sq, runs);
  return balls > 0 ? static_cast<double>(held) / static_cast<double>(balls) : 0.0;
}

float
leastEigenvalue(const NormalTensor& t)
{
  Eigen::Matrix3d m;
  m << t.xx, t.xy, t.xz, t.xy, t.yy, t.yz, t.xz, t.yz, t.zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  return static_cast<float>(std::max(0.0, solver.eigenvalues()[0]));
}

/** Sums of two fields over the balls about the probes. */
void
sumTwo(const kernels::Candidates& candidates, const SortedVectors<float>& probes, double radius, const AlignedArray<float>& first,
       const AlignedArray<float>& second, AlignedArray<float>* out, std::size_t threads)
{
  kernels::FieldSums a;
  a.queries = a.data = probes.vectors();
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.first_field = first.data();
  a.second_field = second.data();
  a.count = out[0].data();
  a.weight_sum = out[1].data();
  a.first_sum = out[2].data();
  a.second_sum = out[3].data();
  parallelBlocks(blockCount(probes.size()), kBlocksPerTask, threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
}

} // namespace

NormalTensors::NormalTensors(PointsView points, const ClusterTree& tree, NormalsView normals, const float* weights, double radius,
                             std::size_t threads)
{
  if (points.size == 0)
    return;
  const double held = meanCount(points, tree, radius);
  while (held > static_cast<double>(kMostData * stride_) && stride_ < points.size)
    stride_ *= 2;
  std::vector<std::uint32_t> places;
  for (std::size_t k = 0; k < points.size; k += stride_)
    places.push_back(static_cast<std::uint32_t>(std::min(k + stride_ / 2, points.size - 1)));
  const SortedVectors<float> probes = gather<float>(points, {}, places, kFarAway, threads);
  const std::size_t padded = places.size() + kQueryBlock;
  AlignedArray<float> products[6], sums[3][4];
  for (AlignedArray<float>& product : products)
    product = AlignedArray<float>(padded);
  for (auto& row : sums)
    for (AlignedArray<float>& sum : row)
      sum = AlignedArray<float>(padded);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const float x = normals.x[places[k]], y = normals.y[places[k]], z = normals.z[places[k]];
    const float values[6] = {x * x, y * y, z * z, y * z, x * z, x * y}, weight = weights ? weights[places[k]] : 1.0f;
    for (std::size_t c = 0; c < 6; ++c)
      products[c][k] = weight * values[c];
  }
  const PointsView view = {probes.x.data(), probes.y.data(), probes.z.data(), places.size()};
  ClusterTree probe_tree;
  probe_tree.fit(view, threads);
  const Neighborhoods near = findNeighborhoods(probe_tree, view, radius, threads);
  for (std::size_t c = 0; c < 3; ++c)
    sumTwo(candidatesOf(near), probes, radius, products[2 * c], products[2 * c + 1], sums[c], threads);
  tensors_.resize(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const float trace = sums[0][2][k] + sums[0][3][k] + sums[1][2][k], scale = trace > 0.0f ? 1.0f / trace : 0.0f;
    tensors_[k] = {sums[0][2][k] * scale, sums[0][3][k] * scale, sums[1][2][k] * scale,
                   sums[1][3][k] * scale, sums[2][2][k] * scale, sums[2][3][k] * scale, 0.0f};
    tensors_[k].least = leastEigenvalue(tensors_[k]);
  }
}

} // namespace pcl_gpf
