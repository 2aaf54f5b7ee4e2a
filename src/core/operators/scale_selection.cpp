// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/operators/scale_selection.h>
#include <pcl_gpf/core/parallel.h>

#include "../analysis/distinct_points.h"
#include "../check_range.h"
#include "../sorted_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Radius of a patch: wide enough to average the noise, narrow enough to lie on a boss. */
constexpr double kPatchNoises = 1.5, kPatchSpacings = 2.5;
/** Neighbourhood over which patches are heard, in patch radii. */
constexpr double kHearing = 4.0;
/** Most probes that a neighbourhood is to hold; more would only cost time. */
constexpr double kMostProbes = 256.0;
/** Normals that deviate by this angle belong to other faces. */
constexpr double kFaceAngle = 30.0 * kPi / 180.0;
/** Least agreement of normals in a patch on one face. */
constexpr float kOneFace = 0.97f;
/** Heights beyond this many noises are outliers and count as this. */
constexpr double kOutlier = 4.0;
/** Mean square of heights, in squares of the noise, which noise alone does not reach. */
constexpr double kMerged = 3.0;
/** Weight of a variance beside a squared bias: 1 for the mean squared error, 2 for Mallows' C_p of a noisy estimate;
 * between them by measurement. */
constexpr double kVariances = 1.5;
/** Standard deviation of a filtered point in units of noise / sqrt(data in the ball). */
constexpr double kSpread = 1.15;

/** Every stride-th of the sorted points, with results for each. */
struct Probes {
  Probes(const SoaBuffer& positions, const SoaBuffer& directions, std::size_t stride)
  : size((positions.size() + stride - 1) / stride)
  , points(size, kFarAway)
  , normals(size)
  , count(size + kQueryBlock)
  , weight(size + kQueryBlock)
  , first(size + kQueryBlock)
  , second(size + kQueryBlock)
  {
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t place = std::min(k * stride + stride / 2, positions.size() - 1);
      points.x[k] = positions.x[place], points.y[k] = positions.y[place], points.z[k] = positions.z[place];
      normals.x[k] = directions.x[place], normals.y[k] = directions.y[place], normals.z[k] = directions.z[place];
    }
  }

  PointsView view() const { return {points.x.data(), points.y.data(), points.z.data(), size}; }

  std::size_t size;
  SortedVectors<float> points, normals;
  AlignedArray<float> count, weight, first, second;
};

/** The elements at `places`, which ascend. */
SoaBuffer
elementsOf(const SoaBuffer& from, const std::vector<std::uint32_t>& places)
{
  SoaBuffer to(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    to.x[k] = from.x[places[k]];
    to.y[k] = from.y[places[k]];
    to.z[k] = from.z[places[k]];
  }
  return to;
}

void
sumFields(kernels::FieldSums a, const ClusterTree& tree, double radius, Probes& probes, std::size_t threads)
{
  a.queries = probes.points.vectors();
  a.query_normals = probes.normals.vectors();
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.count = probes.count.data();
  a.weight_sum = probes.weight.data();
  a.first_sum = probes.first.data();
  a.second_sum = probes.second.data();
  const Neighborhoods near = findNeighborhoods(tree, probes.view(), radius, threads);
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(probes.size), kBlocksPerTask, threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
}

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

/** Means of heights, and of their squares, over the patches about the probes. Uses `positions` up. */
void
averageHeights(PointsView input, SoaBuffer positions, const SoaBuffer& all_normals, double noise, double radius,
               Probes& probes, std::size_t threads)
{
  AlignedArray<float> heights(positions.size() + kQueryBlock), squares(positions.size() + kQueryBlock);
  const auto longest_sq = static_cast<float>(kOutlier * kOutlier * noise * noise);
  for (std::size_t k = 0; k < positions.size(); ++k)
    heights[k] = residualHeight(input, positions, all_normals, k);
  SoaBuffer some_normals;
  if (repeatsManyPoints(input)) { // copies are no further evidence
    const std::vector<std::uint32_t> different = differentPoints(input);
    for (std::size_t k = 0; k < different.size(); ++k)
      heights[k] = heights[different[k]];
    positions = elementsOf(positions, different);
    some_normals = elementsOf(all_normals, different);
  }
  const SoaBuffer& normals = some_normals.size() > 0 ? some_normals : all_normals;
  for (std::size_t k = 0; k < positions.size(); ++k)
    squares[k] = std::min(heights[k] * heights[k], longest_sq);
  markEnd(positions);
  ClusterTree tree;
  tree.fit(positions.view(), threads);
  kernels::FieldSums a;
  a.data = {positions.x.data(), positions.y.data(), positions.z.data()};
  a.data_normals = {normals.x.data(), normals.y.data(), normals.z.data()};
  a.normal_falloff = static_cast<float>(1.0 / (1.0 - std::cos(kFaceAngle)));
  a.first_field = heights.data();
  a.second_field = squares.data();
  sumFields(a, tree, radius, probes, threads);
}

/** Mean squared bias of the coarse surface about each probe, over the patches that lie on one face; 0 where there is
 * none. */
std::vector<double>
squaredBias(double noise_sq, double radius, Probes& probes, std::size_t threads)
{
  AlignedArray<float> bias_sq(probes.size + kQueryBlock), counts(probes.size + kQueryBlock);
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double weight = std::max(1.0f, probes.weight[k]);
    const double mean = probes.first[k] / weight;
    counts[k] = probes.weight[k] > kOneFace * probes.count[k] ? 1.0f : 0.0f;
    const double spread_sq = probes.second[k] / weight;
    // Two sheets drawn together have no mean height, but far more spread than noise.
    const double merged_sq = spread_sq > kMerged * noise_sq ? spread_sq - noise_sq : 0.0;
    bias_sq[k] = counts[k] * static_cast<float>(mean * mean - noise_sq / weight + merged_sq);
  }
  ClusterTree tree;
  tree.fit(probes.view(), threads);
  kernels::FieldSums a;
  a.data = probes.points.vectors();
  a.first_field = bias_sq.data();
  a.second_field = counts.data();
  sumFields(a, tree, radius, probes, threads);
  std::vector<double> mean(probes.size);
  for (std::size_t k = 0; k < probes.size; ++k)
    mean[k] = probes.second[k] > 0.0f ? std::max(0.0, static_cast<double>(probes.first[k]) / probes.second[k]) : 0.0;
  return mean;
}

} // namespace

std::vector<std::uint8_t>
selectFineScale(const ScaleSelectionParameters& p, const PointIndex& points, SoaBuffer coarse_positions,
                const SoaBuffer& coarse_normals)
{
  checkRange("noise", p.noise, p.noise >= 0.0, ">= 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("fine_radius", p.fine_radius, p.fine_radius > 0.0, "> 0");
  checkRange("coarse_radius", p.coarse_radius, p.coarse_radius > p.fine_radius, "> fine_radius");
  std::vector<std::uint8_t> fine(points.size());
  if (points.size() == 0)
    return fine;
  const std::size_t threads = resolveThreads(p.number_of_threads);
  const double patch = boundedRadius(std::max(kPatchNoises * p.noise, kPatchSpacings * p.spacing));
  const double hearing = boundedRadius(kHearing * patch);
  const double dense = kPi * hearing * hearing / (p.spacing * p.spacing) / kMostProbes;
  std::size_t stride = 1;
  while (static_cast<double>(stride) < dense && stride < points.size())
    stride *= 2;

  Probes probes(coarse_positions, coarse_normals, stride);
  averageHeights(points.sorted(), std::move(coarse_positions), coarse_normals, p.noise, patch, probes, threads);
  const std::vector<float> in_patch(probes.weight.data(), probes.weight.data() + probes.size);
  const std::vector<double> bias_sq = squaredBias(p.noise * p.noise, hearing, probes, threads);
  // divided by the data in a ball of radius 1
  const double variance = kSpread * kSpread * p.noise * p.noise * patch * patch;
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double data = std::max(1.0f, in_patch[k]);
    const double coarse_risk = bias_sq[k] + kVariances * variance / (data * p.coarse_radius * p.coarse_radius);
    const double fine_risk = kVariances * variance / (data * p.fine_radius * p.fine_radius);
    const std::size_t end = std::min(points.size(), (k + 1) * stride);
    for (std::size_t i = k * stride; i < end; ++i)
      fine[i] = coarse_risk > fine_risk;
  }
  return fine;
}

} // namespace pcl_gpf
