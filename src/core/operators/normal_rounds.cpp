// SPDX-License-Identifier: BSD-3-Clause
#include "normal_rounds.h"

#include "../check_range.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kPointsPerTask = 8192;
/** Below this length a sum of normals has no direction; the old normal stays. */
constexpr float kShortestSum = 1e-12f;

struct RoundSum {
  double change = 0;
  std::size_t isolated = 0;
};

/** Squared distance of the k-th neighbour of every point, the point itself not counted. */
AlignedArray<float>
neighborRadii(const ClusterTree& tree, PointsView points, unsigned k, std::size_t threads)
{
  AlignedArray<float> radius_sq(points.size + kQueryBlock, 1.0f);
  parallelBlocks(points.size, 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest(points, {points.x[i], points.y[i], points.z[i]}, k + 1, distances_sq);
      // The ball is open: a hair more lets the k-th neighbour in. Coincident points leave a radius that is tiny but not 0.
      radius_sq[i] = std::max(1e-30f, distances_sq.back() * 1.00001f);
    }
  });
  return radius_sq;
}

/** Unit vectors from sums. \param[in] weights number of points behind each vector, or null
 * \return sum of the turns and the number of points that only found themselves */
RoundSum
normalise(const SortedVectors<float>& before, const float* weights, SortedVectors<float>& sums, std::size_t threads)
{
  const std::size_t count = before.size();
  std::vector<RoundSum> partials((count + kPointsPerTask - 1) / kPointsPerTask);
  parallelBlocks(count, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    RoundSum& partial = partials[begin / kPointsPerTask];
    for (std::size_t i = begin; i < end; ++i) {
      const float length = std::sqrt(sums.x[i] * sums.x[i] + sums.y[i] * sums.y[i] + sums.z[i] * sums.z[i]);
      const bool alone = sums.x[i] == before.x[i] && sums.y[i] == before.y[i] && sums.z[i] == before.z[i];
      partial.isolated += alone;
      if (alone || !(length > kShortestSum)) {
        sums.x[i] = before.x[i];
        sums.y[i] = before.y[i];
        sums.z[i] = before.z[i];
        continue;
      }
      sums.x[i] /= length;
      sums.y[i] /= length;
      sums.z[i] /= length;
      const double dx = sums.x[i] - before.x[i], dy = sums.y[i] - before.y[i], dz = sums.z[i] - before.z[i];
      const double turn = 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(dx * dx + dy * dy + dz * dz)));
      partial.change += (weights ? static_cast<double>(weights[i]) : 1.0) * turn;
    }
  });
  RoundSum total;
  for (const RoundSum& partial : partials) {
    total.change += partial.change;
    total.isolated += partial.isolated;
  }
  return total;
}

/** Squared radius of each mean: the largest of its points. */
AlignedArray<float>
radiiOfMeans(const MergedPoints& merged, const AlignedArray<float>& radius_sq)
{
  AlignedArray<float> of_means(radius_sq.empty() ? 0 : merged.size() + kQueryBlock, 0.0f);
  for (std::size_t i = 0; !radius_sq.empty() && i < merged.mean_of.size(); ++i)
    of_means[merged.mean_of[i]] = std::max(of_means[merged.mean_of[i]], radius_sq[i]);
  return of_means;
}

/** Normals of the means given to their points, each with the sign that the point had. */
void
handDown(const MergedPoints& merged, const SortedVectors<float>& means, SortedVectors<float>& normals, std::size_t threads)
{
  parallelBlocks(normals.size(), kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t m = merged.mean_of[i];
      const float cosine = means.x[m] * normals.x[i] + means.y[m] * normals.y[i] + means.z[m] * normals.z[i];
      normals.x[i] = std::copysign(1.0f, cosine) * means.x[m];
      normals.y[i] = std::copysign(1.0f, cosine) * means.y[m];
      normals.z[i] = std::copysign(1.0f, cosine) * means.z[m];
    }
  });
}

} // namespace

NormalRounds::NormalRounds(const BilateralNormalsParameters& parameters, const PointIndex& points, const ProgressCallback& progress)
: parameters_(parameters)
, points_(points)
, progress_(progress)
, threads_(resolveThreads(parameters.number_of_threads))
, radius_(boundedRadius(parameters.radius))
{
  if (parameters.neighbors > 0 && points.size() > 0)
    radius_sq_ = neighborRadii(points.tree(), points.sorted(), parameters.neighbors, threads_);
}

void
NormalRounds::run(SortedVectors<float>& normals, const NeighborSearch& search, BilateralNormalsStatistics& statistics)
{
  if (parameters_.iterations == 0 || points_.size() == 0)
    return;
  // A foreign search has one radius for all, which for k neighbours would be the longest of the cloud.
  const bool foreign = search && parameters_.neighbors == 0;
  MergedPoints merged;
  if (!foreign && parameters_.sign_invariant)
    merged = mergePoints(points_, VectorsView{normals.x.data(), normals.y.data(), normals.z.data(), normals.size()},
                         {radius_, radius_sq_.empty() ? nullptr : radius_sq_.data()}, parameters_.merge_above, true, threads_);
  if (!merged.empty()) {
    runMerged(normals, merged, statistics);
    return;
  }
  const PointsView view = points_.sorted();
  const Neighborhoods near =
      foreign ? transposeLists(search(view, view, radius_), view.size, view.size) : neighborhoods(points_.tree(), view, radius_sq_);
  SortedVectors<float> next(normals.size());
  for (unsigned round = 0; round < parameters_.iterations; ++round) {
    kernels::BilateralNormals a = arguments(view, radius_sq_);
    a.data_normals = normals.vectors();
    filter(near, a, normals, nullptr, next, statistics);
  }
}

void
NormalRounds::runMerged(SortedVectors<float>& normals, MergedPoints& merged, BilateralNormalsStatistics& statistics) const
{
  SortedVectors<float> means = std::move(merged.normals), next(means.size());
  const AlignedArray<float> radius_sq = radiiOfMeans(merged, radius_sq_);
  if (parameters_.iterations > 1) {
    const Neighborhoods near = neighborhoods(merged.tree, merged.view(), radius_sq);
    for (unsigned round = 0; round + 1 < parameters_.iterations; ++round) {
      kernels::BilateralNormals a = arguments(merged.view(), radius_sq);
      a.data_normals = means.vectors();
      a.data_weight = merged.weights.data();
      filter(near, a, means, merged.weights.data(), next, statistics);
    }
    handDown(merged, means, normals, threads_);
  }
  kernels::BilateralNormals a = arguments(points_.sorted(), radius_sq_);
  a.data = merged.positions.vectors();
  a.data_normals = means.vectors();
  a.data_weight = merged.weights.data();
  next = SortedVectors<float>(normals.size());
  filter(neighborhoods(merged.tree, points_.sorted(), radius_sq_), a, normals, nullptr, next, statistics);
}

kernels::BilateralNormals
NormalRounds::arguments(PointsView queries, const AlignedArray<float>& radius_sq) const
{
  kernels::BilateralNormals a;
  a.queries = a.data = {queries.x, queries.y, queries.z};
  a.radius = {static_cast<float>(radius_ * radius_), radius_sq.empty() ? nullptr : radius_sq.data()};
  a.angle_falloff = static_cast<float>(1.0 / (1.0 - std::cos(parameters_.angle * kPi / 180.0)));
  a.sign_invariant = parameters_.sign_invariant;
  return a;
}

Neighborhoods
NormalRounds::neighborhoods(const ClusterTree& tree, PointsView queries, const AlignedArray<float>& radius_sq) const
{
  return radius_sq.empty() ? findNeighborhoods(tree, queries, radius_, threads_)
                           : findNeighborhoods(tree, queries, radius_sq.data(), threads_);
}

void
NormalRounds::filter(const Neighborhoods& near, kernels::BilateralNormals& a, SortedVectors<float>& normals, const float* weights,
                     SortedVectors<float>& next, BilateralNormalsStatistics& statistics) const
{
  if (progress_ && !progress_(static_cast<double>(statistics.mean_change.size()) / parameters_.iterations))
    throw Cancelled();
  a.query_normals = normals.vectors();
  a.out = next.vectors();
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(normals.size()), kBlocksPerTask, threads_,
                 [&](std::size_t begin, std::size_t end) { kernels::active().bilateral_normals(candidates, a, begin, end); });
  const RoundSum sum = normalise(normals, weights, next, threads_);
  statistics.mean_change.push_back(sum.change * 180.0 / kPi / static_cast<double>(points_.size()));
  statistics.isolated_points = sum.isolated;
  std::swap(normals, next);
}

} // namespace pcl_gpf
