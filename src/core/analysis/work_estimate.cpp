// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/simd.h>

#include "../check_range.h"
#include "../merged_points.h"
#include "../neighborhoods.h"
#include "distinct_points.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace pcl_gpf {

namespace {

/** Limits of isExcessive(). */
constexpr double kMostData = 2000.0, kBearableSeconds = 30.0, kBearableSecondsPerPoint = 1e-4;
/** Nanoseconds a datum that a kernel looks at, one thread, AVX-512, balls so large that nearly all data are in them. */
constexpr double kMoments = 0.45, kBilateral = 0.9, kProjection = 0.9, kVariance = 0.5, kRepulsion = 1.1,
                 kGaussian = 0.6, kGapSearch = 5.0, kSides = 1.5;
/** Double instead of float. */
constexpr double kDouble = 4.0;
/** Directions of normals that a group of points to be merged has, which all leave a mean. */
constexpr double kDirections = 4.0;
/** Arrays that the stages hold a point, beside lists. */
constexpr double kBytesPerPoint = 140.0;
/** Rounds of upsampling that look as far as the radius; in later ones gaps are narrower. */
constexpr double kWideRounds = 2.0;

/** How much longer the kernels take than with AVX-512. */
double
slowness()
{
  const std::string target = activeSimdTarget();
  return target == "avx512" ? 1.0 : target == "avx2" ? 1.6 : target == "scalar" ? 12.0 : 3.5;
}

/** Data of one ball. */
struct Ball {
  double data = 0;       ///< that a sum looks at
  double share = 1;      ///< of means among the points
  double list_bytes = 0; ///< of the candidate lists, a query
};

Ball
ballOf(const PointIndex& points, double radius, unsigned merge_above, double directions)
{
  const CandidateCount count = sampleCandidates(points.tree(), points.sorted(), boundedRadius(radius));
  Ball ball{count.data, 1.0, (count.runs * sizeof(Run) + sizeof(std::size_t)) / static_cast<double>(kQueryBlock)};
  double group = 1.0;
  while (merge_above > 0 && ball.data / group > merge_above && group < static_cast<double>(MergedPoints::kLargestGroup))
    group *= 2.0;
  ball.share = std::min(1.0, directions / group);
  ball.data *= ball.share;
  return ball;
}

WorkEstimate
estimateOf(std::string parameter, const PointIndex& points, const Ball& ball)
{
  WorkEstimate work;
  work.parameter = std::move(parameter);
  work.points = points.size();
  work.data_per_point = ball.data;
  work.bytes = static_cast<double>(points.size()) * (kBytesPerPoint + ball.list_bytes);
  return work;
}

void
addPass(double pairs, double nanoseconds, WorkEstimate& work)
{
  work.pairs += pairs;
  work.nominal_seconds += 1e-9 * nanoseconds * pairs;
}

WorkEstimate
onThisMachine(WorkEstimate work, unsigned number_of_threads)
{
  work.seconds = work.nominal_seconds * slowness() / static_cast<double>(resolveThreads(number_of_threads));
  return work;
}

/** In as few digits as tell the size. */
std::string
rounded(double value)
{
  if (value < 10.0)
    return toText(std::max(0.1, std::round(10.0 * value) / 10.0));
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::to_string(static_cast<long long>(std::round(value / unit) * unit));
}

} // namespace

WorkEstimate
estimateWork(const PlaneNormalsParameters& p, const PointIndex& points)
{
  const Ball ball = ballOf(points, p.radius, p.merge_above, 1.0);
  WorkEstimate work = estimateOf("normals.radius", points, ball);
  addPass(static_cast<double>(points.size()) * ball.data, kMoments, work);
  return onThisMachine(std::move(work), p.number_of_threads);
}

WorkEstimate
estimateWork(const BilateralNormalsParameters& p, const PointIndex& points, bool foreign_search)
{
  const bool merged = p.sign_invariant && !foreign_search;
  Ball ball;
  if (p.neighbors > 0)
    ball.data = p.neighbors;
  else
    ball = ballOf(points, p.radius, merged ? p.merge_above : 0, kDirections);
  WorkEstimate work = estimateOf(p.neighbors > 0 ? "bilateral.neighbors" : "bilateral.radius", points, ball);
  const double rounds = p.iterations;
  // The last round alone is for every point, where there are means.
  addPass(static_cast<double>(points.size()) * ball.data * std::min(rounds, 1.0 + (rounds - 1.0) * ball.share),
          kBilateral, work);
  return onThisMachine(std::move(work), p.number_of_threads);
}

WorkEstimate
estimateWork(const GPFParameters& p, const PointIndex& points, std::size_t samples, bool foreign_search)
{
  const bool variance = p.variance_update != VarianceUpdate::Fixed;
  const bool merged =
      !foreign_search && !runsInDouble(p) && !p.density_weights && !p.posterior_normalization && !variance;
  const Ball ball = ballOf(points, 0.5 * p.support_radius, merged ? p.merge_above : 0, kDirections);
  WorkEstimate work = estimateOf("gpf.support_radius", points, ball);
  const double precision = runsInDouble(p) ? kDouble : 1.0, iterations = p.maximum_iterations;
  const auto n = static_cast<double>(points.size()), m = static_cast<double>(samples);
  addPass(iterations * m * ball.data, precision * (kProjection + (variance ? kVariance : 0.0)), work);
  if (p.posterior_normalization)
    addPass(iterations * m * ball.data, precision * kGaussian, work);
  if (p.density_weights)
    addPass(n * ball.data, precision * kGaussian, work);
  if (p.repulsion_weight > 0.0) { // among the samples, in balls twice as wide
    const Ball wide = ballOf(points, p.support_radius, 0, 1.0);
    work.data_per_point = std::max(work.data_per_point, wide.data * m / n);
    addPass(iterations * m * wide.data * m / n, precision * (kRepulsion + (p.density_weights ? kGaussian : 0.0)), work);
  }
  return onThisMachine(std::move(work), p.number_of_threads);
}

WorkEstimate
estimateWork(const EdgeAwareUpsamplingParameters& p, const PointIndex& points)
{
  std::unique_ptr<PointIndex> distinct; // copies take no part in the search for gaps
  if (repeatsManyPoints(points.sorted()))
    distinct = std::make_unique<PointIndex>(distinctPoints(points.sorted()).view(), p.number_of_threads);
  const PointIndex& searched = distinct ? *distinct : points;
  const Ball ball = ballOf(searched, p.radius, 0, 1.0);
  WorkEstimate work = estimateOf("upsampling.radius", points, ball);
  const auto inserted = static_cast<double>(targetCount(p, points.size()) - points.size());
  work.bytes += inserted * (kBytesPerPoint + ball.list_bytes);
  addPass(kWideRounds * static_cast<double>(searched.size()) * ball.data, kGapSearch, work);
  addPass((p.spacing > 0.0 ? static_cast<double>(points.size()) : inserted) * ball.data, kSides, work);
  return onThisMachine(std::move(work), p.number_of_threads);
}

bool
isExcessive(const WorkEstimate& work)
{
  return work.data_per_point > kMostData &&
         work.nominal_seconds > kBearableSeconds + kBearableSecondsPerPoint * static_cast<double>(work.points);
}

void
refuseExcessiveWork(const WorkEstimate& work)
{
  if (isExcessive(work))
    throw ExcessiveWork(work.parameter + " is so large that a point has about " + rounded(work.data_per_point) +
                        " neighbours: " + rounded(work.pairs / 1e9) + " billion pairs, roughly " +
                        rounded(work.seconds) + " s and " + rounded(work.bytes / 1e6) + " MB; choose a smaller radius");
}

} // namespace pcl_gpf
