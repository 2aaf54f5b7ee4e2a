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
/** Heights beyond this many noises of their surroundings are outliers and count as this. */
constexpr double kOutlier = 4.0;
/** Points along the curve whose median height tells the noise of the surroundings; deviation of noise of median size 1. */
constexpr std::size_t kSurroundings = 128;
constexpr double kMedianToDeviation = 1.4826;
/** Mean square of heights, in squares of the noise, from which on they may be those of two sheets. */
constexpr double kSpreadOut = 3.0;
/** Least mean size of heights, in roots of their mean square, of two sheets: 0.8 for noise of any strength, 1 for bare sheets. */
constexpr double kTwoSheets = 0.85;
/** Weight of a variance beside a squared bias: 1 for the mean squared error, 2 for Mallows' C_p; between them by measurement. */
constexpr double kVariances = 1.2;
/** Standard deviation of a filtered point in units of noise / sqrt(data in the ball). */
constexpr double kSpread = 1.15;

/** Every stride-th of the sorted points. */
struct Probes {
  Probes(const SoaBuffer& positions, const SoaBuffer& directions, std::size_t stride)
  : size((positions.size() + stride - 1) / stride), points(size, kFarAway), normals(size)
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
};

/** Sums over the data in the balls about the probes. */
struct Sums {
  explicit Sums(std::size_t padded) : count(padded), weight(padded), first(padded), second(padded) {}

  AlignedArray<float> count, weight, first, second;
};

class Balls {
public:
  Balls(const Probes& probes, PointsView data, double radius, std::size_t threads) : probes_(probes), threads_(threads)
  {
    ClusterTree tree;
    tree.fit(data, threads);
    near_ = findNeighborhoods(tree, probes.view(), radius, threads);
    fields_.data = {data.x, data.y, data.z};
    fields_.queries = probes.points.vectors();
    fields_.radius.radius_sq = static_cast<float>(radius * radius);
  }

  /** Lets data weigh as much as their normals agree with the probe's. */
  void
  weigh(const SoaBuffer& normals)
  {
    fields_.data_normals = {normals.x.data(), normals.y.data(), normals.z.data()};
    fields_.query_normals = probes_.normals.vectors();
    fields_.normal_falloff = static_cast<float>(1.0 / (1.0 - std::cos(kFaceAngle)));
  }

  Sums
  sum(const AlignedArray<float>& first, const AlignedArray<float>& second) const
  {
    Sums sums(probes_.size + kQueryBlock);
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

private:
  const Probes& probes_;
  std::size_t threads_;
  Neighborhoods near_;
  kernels::FieldSums fields_;
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

/** Means over the patches about the probes. */
struct Patches {
  std::vector<std::uint8_t> one_face; ///< 0: reaches across an edge
  std::vector<float> data, mean, mean_size, mean_square; ///< sum of weights; of heights
};

/** Uses `positions` up. */
Patches
averageHeights(PointsView input, SoaBuffer positions, const SoaBuffer& all_normals, double noise, double radius, const Probes& probes,
               std::size_t threads)
{
  AlignedArray<float> heights(positions.size() + kQueryBlock);
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
  const Sums powers = balls.sum(heights, squares), lengths = balls.sum(sizes, squares);
  Patches patches;
  for (std::size_t k = 0; k < probes.size; ++k) {
    const float weight = std::max(1.0f, powers.weight[k]);
    patches.data.push_back(weight);
    patches.one_face.push_back(powers.weight[k] > kOneFace * powers.count[k]);
    patches.mean.push_back(powers.first[k] / weight);
    patches.mean_square.push_back(powers.second[k] / weight);
    patches.mean_size.push_back(lengths.first[k] / weight);
  }
  return patches;
}

/** What the patches about a probe say together. */
struct Hearing {
  double bias_sq;  ///< mean squared bias of the coarse surface
  double noise_sq; ///< variance of heights, no less than the noise of the cloud
};

/** Hears the patches on one face about each probe; no bias where there is none. */
std::vector<Hearing>
hear(const Patches& patches, double noise_sq, double radius, const Probes& probes, std::size_t threads)
{
  const std::size_t padded = probes.size + kQueryBlock;
  AlignedArray<float> heard(padded), bias_sq(padded), variance(padded), wide(padded), wide_size(padded), wide_square(padded);
  for (std::size_t k = 0; k < probes.size; ++k) {
    if (!patches.one_face[k])
      continue;
    const double mean_sq = static_cast<double>(patches.mean[k]) * patches.mean[k], square = patches.mean_square[k];
    heard[k] = 1.0f;
    bias_sq[k] = static_cast<float>(mean_sq - std::max(noise_sq, square - mean_sq) / patches.data[k]);
    variance[k] = static_cast<float>(square - mean_sq);
    if (square > kSpreadOut * noise_sq) {
      wide[k] = 1.0f;
      wide_size[k] = patches.mean_size[k];
      wide_square[k] = patches.mean_square[k];
    }
  }
  const Balls balls(probes, probes.view(), radius, threads);
  const Sums biases = balls.sum(bias_sq, heard), variances = balls.sum(variance, wide), shape = balls.sum(wide_size, wide_square);
  std::vector<Hearing> all(probes.size, {0.0, noise_sq});
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double patches_heard = biases.second[k], patches_wide = variances.second[k];
    if (patches_heard <= 0.0)
      continue;
    // Two sheets drawn together have no mean height, but spread more than noise, and few heights are small.
    const double size = shape.first[k], square = shape.second[k];
    const bool two_sheets = size * size > kTwoSheets * kTwoSheets * square * patches_wide;
    const double merged_sq = two_sheets ? square - patches_wide * noise_sq : 0.0;
    all[k].bias_sq = std::max(0.0, (static_cast<double>(biases.first[k]) + merged_sq) / patches_heard);
    if (!two_sheets)
      all[k].noise_sq = std::max(noise_sq, variances.first[k] / patches_heard);
  }
  return all;
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

  const Probes probes(coarse_positions, coarse_normals, stride);
  const Patches patches =
      averageHeights(points.sorted(), std::move(coarse_positions), coarse_normals, p.noise, patch, probes, threads);
  const std::vector<Hearing> heard = hear(patches, p.noise * p.noise, hearing, probes, threads);
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double data = patches.data[k] / (patch * patch); // in a ball of radius 1
    const double variance = kVariances * kSpread * kSpread * heard[k].noise_sq / data;
    const double coarse_risk = heard[k].bias_sq + variance / (p.coarse_radius * p.coarse_radius);
    const double fine_risk = variance / (p.fine_radius * p.fine_radius);
    const std::size_t end = std::min(points.size(), (k + 1) * stride);
    for (std::size_t i = k * stride; i < end; ++i)
      fine[i] = coarse_risk > fine_risk;
  }
  return fine;
}

} // namespace pcl_gpf
