// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "../sorted_points.h"

#include <chrono>
#include <cmath>

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

/** Unit vectors from sums; \return mean of the turns and the number of points that only found themselves */
RoundSum
normalise(const SortedVectors<float>& before, SortedVectors<float>& sums, std::size_t threads)
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
      partial.change += 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(dx * dx + dy * dy + dz * dz)));
    }
  });
  RoundSum total;
  for (const RoundSum& partial : partials) {
    total.change += partial.change;
    total.isolated += partial.isolated;
  }
  return total;
}

SortedVectors<float>
unitVectors(VectorsView normals)
{
  SortedVectors<float> unit(normals.size);
  for (std::size_t i = 0; i < normals.size; ++i) {
    const double x = normals.x[i], y = normals.y[i], z = normals.z[i];
    const double length = std::sqrt(x * x + y * y + z * z);
    // A unit vector stays what it is to the last bit.
    const double scale = length > 0.0 && std::abs(length - 1.0) > 1e-6 ? 1.0 / length : 1.0;
    unit.x[i] = static_cast<float>(x * scale);
    unit.y[i] = static_cast<float>(y * scale);
    unit.z[i] = static_cast<float>(z * scale);
  }
  return unit;
}

} // namespace

void
validate(const BilateralNormalsParameters& p)
{
  checkRange("bilateral radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("bilateral neighbors", p.neighbors, p.neighbors == 0 || (p.neighbors >= 3 && p.neighbors <= 1000), "0 or 3 .. 1000");
  checkRange("bilateral angle", p.angle, p.angle > 0.0 && p.angle <= 90.0, "0 < angle <= 90 degrees");
  checkRange("bilateral iterations", p.iterations, p.iterations <= 1000, "0 .. 1000");
  if (p.radius > 0.0 && p.neighbors > 0)
    throw InvalidParameter("bilateral radius and neighbors exclude each other; both are set");
}

BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters, PointsView points, MutableVectorsView normals,
                         const NeighborSearch& search, const ProgressCallback& progress)
{
  const PointIndex index(points, parameters.number_of_threads);
  SoaBuffer sorted(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    sorted.x[k] = normals.x[index.order()[k]];
    sorted.y[k] = normals.y[index.order()[k]];
    sorted.z[k] = normals.z[index.order()[k]];
  }
  BilateralNormalsStatistics statistics = filterNormalsBilaterally(parameters, index, sorted.view(), search, progress);
  for (std::size_t k = 0; k < index.size(); ++k) {
    normals.x[index.order()[k]] = sorted.x[k];
    normals.y[index.order()[k]] = sorted.y[k];
    normals.z[index.order()[k]] = sorted.z[k];
  }
  return statistics;
}

BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters, const PointIndex& points, MutableVectorsView normals,
                         const NeighborSearch& search, const ProgressCallback& progress)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  if (parameters.radius <= 0.0 && parameters.neighbors == 0)
    throw InvalidParameter("bilateral radius or neighbors must be set; both are 0");
  const std::size_t threads = resolveThreads(parameters.number_of_threads);
  const PointsView view = points.sorted();
  const std::size_t count = view.size;
  SortedVectors<float> current = unitVectors(normals), next(count);

  kernels::BilateralNormals a;
  a.queries = a.data = {view.x, view.y, view.z};
  AlignedArray<float> radius_sq;
  if (parameters.neighbors > 0 && count > 0) {
    radius_sq = neighborRadii(points.tree(), view, parameters.neighbors, threads);
    a.radius.per_query = radius_sq.data();
  }
  const double radius = boundedRadius(parameters.radius);
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.angle_falloff = static_cast<float>(1.0 / (1.0 - std::cos(parameters.angle * kPi / 180.0)));
  a.sign_invariant = parameters.sign_invariant;

  BilateralNormalsStatistics statistics;
  Neighborhoods near;
  if (parameters.iterations > 0 && count > 0)
    // A foreign search has one radius for all, which for k neighbours would be the longest of the cloud.
    near = parameters.neighbors > 0 ? findNeighborhoods(points.tree(), view, radius_sq.data(), threads)
           : search                 ? transposeLists(search(view, view, radius), count)
                                    : findNeighborhoods(points.tree(), view, radius, threads);
  const kernels::Candidates candidates = candidatesOf(near);
  for (unsigned round = 0; round < parameters.iterations; ++round) {
    if (progress && !progress(static_cast<double>(round) / parameters.iterations))
      throw Cancelled();
    a.query_normals = a.data_normals = current.vectors();
    a.out = next.vectors();
    parallelBlocks(blockCount(count), kBlocksPerTask, threads,
                   [&](std::size_t begin, std::size_t end) { kernels::active().bilateral_normals(candidates, a, begin, end); });
    const RoundSum sum = normalise(current, next, threads);
    statistics.mean_change.push_back(sum.change * 180.0 / kPi / static_cast<double>(std::max<std::size_t>(1, count)));
    statistics.isolated_points = sum.isolated;
    std::swap(current, next);
  }
  std::copy_n(current.x.data(), count, normals.x);
  std::copy_n(current.y.data(), count, normals.y);
  std::copy_n(current.z.data(), count, normals.z);
  if (progress && !progress(1.0))
    throw Cancelled();
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return statistics;
}

} // namespace pcl_gpf
