// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/parallel.h>

#include "distinct_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr std::size_t kMostProbes = 1024;
constexpr std::size_t kNeighbor = 16;
constexpr double kPi = 3.14159265358979323846;

/** Squared distances of one point. */
class NeighborDistances {
public:
  explicit NeighborDistances(const PointIndex& points) : points_(points) {}

  /** To the neighbour-th nearest other point. Those near on the curve tell how far the tree has to be searched. */
  float
  of(std::size_t i, std::size_t neighbor)
  {
    const std::size_t window = std::min(points_.size(), 2 * kNeighbor + 1);
    const std::size_t begin = std::min(i - std::min(i, kNeighbor), points_.size() - window);
    runs_.assign(1, {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + window)});
    const float bound = smallest(i, neighbor, std::numeric_limits<float>::infinity());
    if (!std::isfinite(bound))
      return bound; // squares that float does not hold: the tree would find too few
    const PointsView p = points_.sorted();
    const std::array<float, 3> position{p.x[i], p.y[i], p.z[i]};
    runs_.clear();
    points_.tree().collectRuns({position, position}, std::sqrt(bound) * 1.0001f, runs_);
    return smallest(i, neighbor, bound);
  }

private:
  /** Of the squared distances up to a bound, of which there are more than `rank`. */
  float
  smallest(std::size_t i, std::size_t rank, float bound)
  {
    const PointsView p = points_.sorted();
    distances_sq_.clear();
    for (const Run run : runs_)
      for (std::uint32_t j = run.begin; j < run.end; ++j) {
        const float dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
        const float distance_sq = dx * dx + dy * dy + dz * dz;
        if (!(distance_sq > bound))
          distances_sq_.push_back(distance_sq);
      }
    const auto middle = distances_sq_.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(distances_sq_.begin(), middle, distances_sq_.end());
    return *middle;
  }

  const PointIndex& points_;
  std::vector<Run> runs_;
  std::vector<float> distances_sq_;
};

} // namespace

double
estimateSpacing(PointsView points, unsigned number_of_threads)
{
  return estimateSpacing(PointIndex(points, number_of_threads), number_of_threads);
}

double
estimateSpacing(const PointIndex& points, unsigned number_of_threads)
{
  if (points.size() < 2)
    return 0.0;
  const PointsView view = points.sorted();
  const std::size_t neighbor = std::min(kNeighbor, points.size() - 1);
  const std::size_t probes = std::min(kMostProbes, points.size());
  std::vector<float> distances_sq(probes);
  parallelBlocks(probes, 64, resolveThreads(number_of_threads), [&](std::size_t begin, std::size_t end) {
    NeighborDistances distances(points);
    for (std::size_t probe = begin; probe < end; ++probe) // even steps along the curve: even over the surface
      distances_sq[probe] = distances.of(probe * points.size() / probes, neighbor);
  });
  // Duplicates have no spacing; the median is taken over points that have neighbours elsewhere.
  distances_sq.erase(std::remove(distances_sq.begin(), distances_sq.end(), 0.0f), distances_sq.end());
  if (distances_sq.empty()) { // a few piles of coincident points
    const SoaBuffer distinct = distinctPoints(view);
    return distinct.size() < points.size() ? estimateSpacing(distinct.view(), number_of_threads) : 0.0;
  }
  const auto middle = distances_sq.begin() + static_cast<std::ptrdiff_t>(distances_sq.size() / 2);
  std::nth_element(distances_sq.begin(), middle, distances_sq.end());
  return std::sqrt(*middle * kPi / static_cast<double>(neighbor));
}

double
spacingWithoutNoise(double apparent_spacing, double noise)
{
  if (!(noise > 0.0) || !(apparent_spacing > 0.0))
    return apparent_spacing;
  // The ball about a point at height h holds the area of a disc of radius d, were it flat; of that, at distance u of the height that
  // ring reaches, the share of the normal distribution between h - u and h + u. Integrated over the ring by Simpson's rule.
  constexpr int kSteps = 64;
  constexpr double kMedianHeight = 0.6744897501960817; // half of the points are nearer to the surface, in units of the noise
  const double distance = apparent_spacing * std::sqrt(static_cast<double>(kNeighbor) / kPi) / noise;
  const auto cumulative = [](double z) { return 0.5 * std::erfc(-z * std::sqrt(0.5)); };
  double sum = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    const double u = distance * step / kSteps;
    const double weight = step == 0 || step == kSteps ? 1.0 : step % 2 == 1 ? 4.0 : 2.0;
    sum += weight * u * (cumulative(kMedianHeight + u) - cumulative(kMedianHeight - u));
  }
  const double share = 2.0 * sum / (3.0 * kSteps * distance);
  return apparent_spacing * std::sqrt(std::min(1.0, share));
}

} // namespace pcl_gpf
