// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/edge_aware_upsampling.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "../sorted_points.h"
#include "upsampling_rounds.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr double kMostFactor = 1000.0;
constexpr double kRadiusInSpacings = 3.0;
/** Share of the requested spacing down to which clearances are filled, so that estimateSpacing() of the result is the request. */
constexpr double kClearanceOfSpacing = 0.775;
/** What float cannot hold in the frame whose box diagonal is 1; less where one point that strayed far makes that frame wide beside the
 * spacing of the others, which lie about its origin. */
constexpr double kRounding = 1e-6, kRoundingOfSpacing = 1e-3;

/** In the order of `order`, or as they are when that is empty. */
SoaBuffer
unitVectors(NormalsView normals, const std::vector<std::uint32_t>& order)
{
  SoaBuffer unit(normals.size);
  for (std::size_t k = 0; k < normals.size; ++k) {
    const std::size_t i = order.empty() ? k : order[k];
    const double x = normals.x[i], y = normals.y[i], z = normals.z[i];
    const double length = std::sqrt(x * x + y * y + z * z);
    unit.x[k] = static_cast<float>(x / length);
    unit.y[k] = static_cast<float>(y / length);
    unit.z[k] = static_cast<float>(z / length);
  }
  return unit;
}

/** What the rounds need, all of it known: lengths are set and checked against the data. */
UpsamplingPlan
makePlan(const EdgeAwareUpsamplingParameters& p, const PointIndex& points, double spacing)
{
  UpsamplingPlan plan;
  plan.target = targetCount(p, points.size());
  plan.radius = boundedRadius(p.radius > 0.0 ? p.radius : kRadiusInSpacings * spacing);
  if (p.spacing > 0.0) {
    const double count = static_cast<double>(points.size()) * (spacing / p.spacing) * (spacing / p.spacing);
    if (count > static_cast<double>(plan.target))
      throw ExcessiveWork("a spacing of " + toText(p.spacing) + " needs about " + toText(std::round(count)) +
                          " points, the input has " + std::to_string(points.size()) + " with a spacing of " + toText(spacing) +
                          " (both in the frame of the points); at most 1000 times as many are made");
    plan.least_clearance = kClearanceOfSpacing * p.spacing;
  }
  plan.rounding = std::min(kRounding, kRoundingOfSpacing * spacing);
  plan.angle = p.angle * 3.14159265358979323846 / 180.0;
  plan.edge_sensitivity = p.edge_sensitivity;
  plan.sign_invariant = p.sign_invariant;
  plan.threads = resolveThreads(p.number_of_threads);
  return plan;
}

void
requireSurface(PointsView points)
{
  if (points.size < 3)
    throw UnsuitableData(std::to_string(points.size) + " points; a surface needs at least 3");
  if (!spansSurface(points))
    throw UnsuitableData("all points coincide or lie on one line; there is no surface to fill");
}

EdgeAwareUpsamplingResult
upsampleSorted(const EdgeAwareUpsamplingParameters& parameters, const PointIndex& points, double spacing,
               const SoaBuffer& unit_normals, const ProgressCallback& progress)
{
  const UpsamplingPlan plan = makePlan(parameters, points, spacing);
  EdgeAwareUpsamplingParameters known = parameters;
  known.radius = plan.radius;
  refuseExcessiveWork(estimateWork(known, points));
  UpsamplingRounds rounds(plan, points, unit_normals.view());
  double reported = 0.0;
  do {
    reported = std::max(reported, rounds.fractionDone()); // a later estimate may be lower
    if (progress && !progress(reported))
      throw Cancelled();
  } while (rounds.step());
  EdgeAwareUpsamplingResult result = rounds.result();
  if (progress && !progress(1.0))
    throw Cancelled();
  return result;
}

double
secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

void
validate(const EdgeAwareUpsamplingParameters& p)
{
  checkRange("upsampling factor", p.factor, p.factor == 0.0 || (p.factor >= 1.0 && p.factor <= kMostFactor), "0 or 1 .. 1000");
  checkRange("upsampling spacing", p.spacing, p.spacing >= 0.0, ">= 0, 0 = by the count or factor");
  checkRange("upsampling radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("upsampling angle", p.angle, p.angle > 0.0 && p.angle <= 90.0, "0 < angle <= 90 degrees");
  checkRange("edge sensitivity", p.edge_sensitivity, p.edge_sensitivity >= 0.0 && p.edge_sensitivity <= 10.0, "0 .. 10");
  if ((p.target_count > 0) + (p.factor > 0.0) + (p.spacing > 0.0) > 1)
    throw InvalidParameter("target count, factor and spacing exclude each other; more than one is set");
}

std::size_t
targetCount(const EdgeAwareUpsamplingParameters& p, std::size_t input)
{
  const double most = kMostFactor * static_cast<double>(input);
  double target = static_cast<double>(p.target_count);
  if (p.target_count == 0 && p.spacing > 0.0)
    target = std::min(most, static_cast<double>(kMostCloudPoints));
  else if (p.target_count == 0)
    target = std::floor((p.factor > 0.0 ? p.factor : 2.0) * static_cast<double>(input) + 0.5);
  checkRange("target count", target, target >= static_cast<double>(input) && target <= most,
             ("from the " + std::to_string(input) + " points of the input to 1000 times as many").c_str());
  if (target > static_cast<double>(kMostCloudPoints))
    throw ExcessiveWork("the target is " + toText(target) + " points; the limit of one cloud is " + std::to_string(kMostCloudPoints));
  return static_cast<std::size_t>(target);
}

EdgeAwareUpsamplingResult
upsampleEdgeAware(const EdgeAwareUpsamplingParameters& parameters, PointsView points, NormalsView normals,
                  const ProgressCallback& progress)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  requireSurface(points);
  const PointIndex index(points, parameters.number_of_threads);
  EdgeAwareUpsamplingResult result = upsampleSorted(parameters, index, estimateSpacing(index, parameters.number_of_threads),
                                                    unitVectors(normals, index.order()), progress);
  const std::vector<std::uint32_t>& order = index.order();
  for (std::vector<std::uint32_t>* numbers : {&result.parents, &result.first_base, &result.second_base})
    for (std::uint32_t& number : *numbers)
      number = number < order.size() ? order[number] : number;
  result.seconds = secondsSince(start);
  return result;
}

EdgeAwareUpsamplingResult
upsampleEdgeAware(const EdgeAwareUpsamplingParameters& parameters, const PointIndex& points, NormalsView normals,
                  double spacing, const ProgressCallback& progress)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  requireSurface(points.sorted());
  EdgeAwareUpsamplingResult result = upsampleSorted(parameters, points, spacing, unitVectors(normals, {}), progress);
  result.seconds = secondsSince(start);
  return result;
}

} // namespace pcl_gpf
