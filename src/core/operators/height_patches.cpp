// SPDX-License-Identifier: BSD-3-Clause
#include "height_patches.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>

#include "../analysis/distinct_points.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Normals that deviate by this angle belong to other faces. */
constexpr double kFaceAngle = 30.0 * kPi / 180.0;
/** Least agreement of normals in a patch on one face. */
constexpr float kOneFace = 0.97f;
/** Heights beyond this many noises of their surroundings are outliers and count as this. */
constexpr double kOutlier = 4.0;
/** Points along the curve whose median height tells the noise of the surroundings; deviation of noise of median size 1. */
constexpr std::size_t kSurroundings = 128;
constexpr double kMedianToDeviation = 1.4826;

/** Height of a point of the input above the coarse surface, along its normal. */
float
residualHeight(PointsView input, const SoaBuffer& positions, const SoaBuffer& normals, std::size_t i)
{
  return (input.x[i] - positions.x[i]) * normals.x[i] + (input.y[i] - positions.y[i]) * normals.y[i] +
         (input.z[i] - positions.z[i]) * normals.z[i];
}

/** The data as kernels want them: arrays have a padded element behind their end, which must be far away. */
void
markEnd(SoaBuffer& positions)
{
  for (AlignedArray<float>* axis : {&positions.x, &positions.y, &positions.z})
    std::fill_n(axis->end(), AlignedArray<float>::kPadding, kFarAway);
}

/** Cuts heights to kOutlier deviations of those nearby, whose median outliers do not move. */
void
cutOutliers(double noise, std::size_t count, AlignedArray<float>& heights)
{
  std::vector<float> nearby;
  for (std::size_t begin = 0; begin < count; begin += kSurroundings) {
    const std::size_t end = std::min(count, begin + kSurroundings);
    nearby.clear();
    for (std::size_t k = begin; k < end; ++k)
      nearby.push_back(std::abs(heights[k]));
    const auto middle = nearby.begin() + static_cast<std::ptrdiff_t>(nearby.size() / 2);
    std::nth_element(nearby.begin(), middle, nearby.end());
    const auto longest = static_cast<float>(kOutlier * std::max(noise, kMedianToDeviation * static_cast<double>(*middle)));
    for (std::size_t k = begin; k < end; ++k)
      heights[k] = std::min(std::max(heights[k], -longest), longest);
  }
}

} // namespace

Probes::Probes(const SoaBuffer& positions, const SoaBuffer& directions, std::size_t stride)
: size((positions.size() + stride - 1) / stride), points(size, kFarAway), normals(size)
{
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t place = std::min(k * stride + stride / 2, positions.size() - 1);
    points.x[k] = positions.x[place], points.y[k] = positions.y[place], points.z[k] = positions.z[place];
    normals.x[k] = directions.x[place], normals.y[k] = directions.y[place], normals.z[k] = directions.z[place];
  }
}

Balls::Balls(const Probes& probes, PointsView data, double radius, std::size_t threads) : probes_(probes), threads_(threads)
{
  ClusterTree tree;
  tree.fit(data, threads);
  near_ = findNeighborhoods(tree, probes.view(), radius, threads);
  fields_.data = {data.x, data.y, data.z};
  fields_.queries = probes.points.vectors();
  fields_.radius.radius_sq = static_cast<float>(radius * radius);
}

void
Balls::weigh(const SoaBuffer& normals)
{
  fields_.data_normals = {normals.x.data(), normals.y.data(), normals.z.data()};
  fields_.query_normals = probes_.normals.vectors();
  fields_.along_normals = true;
  fields_.normal_falloff = static_cast<float>(1.0 / (1.0 - std::cos(kFaceAngle)));
}

FieldTotals
Balls::sum(const AlignedArray<float>& first, const AlignedArray<float>& second) const
{
  FieldTotals sums(probes_.size + kQueryBlock);
  kernels::FieldSums a = fields_;
  a.first_field = first.data();
  a.second_field = second.data();
  a.count = sums.count.data();
  a.weight_sum = sums.weight.data();
  a.first_sum = sums.first.data();
  a.second_sum = sums.second.data();
  const kernels::Candidates candidates = candidatesOf(near_);
  parallelBlocks(blockCount(probes_.size), kBlocksPerTask, threads_,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
  return sums;
}

HeightPatches
averageHeights(PointsView input, SoaBuffer positions, const SoaBuffer& all_normals, double noise, double radius, const Probes& probes,
               std::size_t threads, bool with_sizes)
{
  AlignedArray<float> heights(positions.size() + kQueryBlock);
  for (std::size_t k = 0; k < positions.size(); ++k)
    heights[k] = residualHeight(input, positions, all_normals, k);
  SoaBuffer some_normals;
  if (repeatsManyPoints(input)) { // copies are no further evidence
    const std::vector<std::uint32_t> different = differentPoints(input);
    for (std::size_t k = 0; k < different.size(); ++k)
      heights[k] = heights[different[k]];
    positions = elementsOf(positions.view(), different);
    some_normals = elementsOf(all_normals.view(), different);
  }
  const std::size_t count = positions.size();
  cutOutliers(noise, count, heights);
  AlignedArray<float> sizes(count + kQueryBlock), squares(count + kQueryBlock);
  for (std::size_t k = 0; k < count; ++k) {
    sizes[k] = std::abs(heights[k]);
    squares[k] = heights[k] * heights[k];
  }
  markEnd(positions);
  Balls balls(probes, positions.view(), radius, threads);
  balls.weigh(some_normals.size() > 0 ? some_normals : all_normals);
  const FieldTotals powers = balls.sum(heights, squares), lengths = with_sizes ? balls.sum(heights, sizes) : FieldTotals(0);
  HeightPatches patches;
  for (std::size_t k = 0; k < probes.size; ++k) {
    const float weight = std::max(1.0f, powers.weight[k]);
    patches.count.push_back(powers.count[k]);
    patches.data.push_back(weight);
    patches.one_face.push_back(powers.weight[k] > kOneFace * powers.count[k]);
    patches.mean.push_back(powers.first[k] / weight);
    patches.mean_square.push_back(powers.second[k] / weight);
    if (with_sizes)
      patches.mean_size.push_back(lengths.second[k] / weight);
  }
  return patches;
}

} // namespace pcl_gpf
