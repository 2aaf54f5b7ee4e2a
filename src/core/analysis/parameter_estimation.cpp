// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/local_frame.h>

#include "../check_range.h"
#include "distinct_points.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** A length as multiples of the noise and of the spacing. */
struct LengthRule {
  double noises, spacings;
  bool larger = false; ///< about the larger of the two; else they add up like independent errors
};
struct ScaleRules {
  LengthRule normals, bilateral, support;
};

/** Why these: docs/gpf.md, "Where the estimated lengths come from". */
ScaleRules
rulesOf(FilterScale filter_scale)
{
  switch (filter_scale) {
  case FilterScale::Coarse: return {{4.3, 2.2}, {8.8, 6.3}, {11.8, 8.0}};
  case FilterScale::Fine: return {{2.1, 2.8, true}, {3.05, 3.2, true}, {4.5, 6.0, true}};
  case FilterScale::Finest: return {{1.9, 1.8, true}, {2.5, 2.2, true}, {3.8, 3.1, true}};
  default: return {{4.0, 2.2}, {8.0, 6.0}, {11.0, 8.0}};
  }
}

constexpr LengthRule kSteeredRadius = {2.52, 3.3, true}, kDirectionRadius = {4.6, 6.9}, kQuadricRadius = {5.9, 9.0};

ParameterOrigin
lengthFromScale(const char* name, const CloudScale& scale, const LengthRule& rule)
{
  const double noises = rule.noises * scale.noise, spacings = rule.spacings * scale.spacing;
  const double length = rule.larger ? std::cbrt(std::pow(noises, 3) + std::pow(spacings, 3)) : std::hypot(noises, spacings);
  return {name, length, "estimated", toText(rule.noises) + " x noise " + (rule.larger ? "(max) " : "(+) ") + toText(rule.spacings) + " x spacing"};
}

void
fill(double& value, ParameterOrigin estimate, std::vector<ParameterOrigin>& origins)
{
  if (value > 0.0)
    estimate = {estimate.name, value, "user", ""};
  value = estimate.value;
  origins.push_back(std::move(estimate));
}

void
measureSurface(const PointIndex& points, unsigned number_of_threads, CloudScale& scale)
{
  const double apparent_spacing = estimateSpacing(points, number_of_threads);
  scale.noise = estimateNoise(points, apparent_spacing, number_of_threads);
  scale.spacing = spacingWithoutNoise(apparent_spacing, scale.noise);
}

} // namespace

CloudScale
measureScale(PointsView points, unsigned number_of_threads)
{
  return measureScale(PointIndex(points, number_of_threads), number_of_threads);
}

CloudScale
measureScale(const PointIndex& points, unsigned number_of_threads)
{
  CloudScale scale;
  if (points.size() == 0)
    return scale;
  const FloatBox bounds = points.tree().bounds();
  BoundingBox box;
  box.add(bounds.min[0], bounds.min[1], bounds.min[2]);
  box.add(bounds.max[0], bounds.max[1], bounds.max[2]);
  scale.diagonal = box.diagonal();
  scale.h0 = scale.diagonal / std::sqrt(static_cast<double>(points.size()));
  if (repeatsManyPoints(points.sorted())) {
    const SoaBuffer distinct = distinctPoints(points.sorted());
    measureSurface(PointIndex(distinct.view(), number_of_threads), number_of_threads, scale);
  } else
    measureSurface(points, number_of_threads, scale);
  return scale;
}

std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, PlaneNormalsParameters& normals, BilateralNormalsParameters& bilateral,
                   GPFParameters& gpf, FilterScale filter_scale)
{
  const ScaleRules rules = rulesOf(filter_scale);
  std::vector<ParameterOrigin> origins;
  fill(normals.radius, lengthFromScale("normals.radius", scale, rules.normals), origins);
  if (bilateral.neighbors == 0)
    fill(bilateral.radius, lengthFromScale("bilateral.radius", scale, rules.bilateral), origins);
  const bool paper = gpf.variance_update == VarianceUpdate::Paper && gpf.posterior_normalization;
  if (paper)
    fill(gpf.support_radius, {"gpf.support_radius", 8.0 * scale.h0, "preset", "8 x h0, within the paper's 3 .. 12"}, origins);
  else
    fill(gpf.support_radius, lengthFromScale("gpf.support_radius", scale, rules.support), origins);
  return origins;
}

std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, SteeredFitParameters& steered)
{
  std::vector<ParameterOrigin> origins;
  fill(steered.radius, lengthFromScale("steered.radius", scale, kSteeredRadius), origins);
  fill(steered.direction_radius, lengthFromScale("steered.direction_radius", scale, kDirectionRadius), origins);
  return origins;
}

std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, QuadricFitParameters& quadric)
{
  std::vector<ParameterOrigin> origins;
  fill(quadric.radius, lengthFromScale("quadric.radius", scale, kQuadricRadius), origins);
  return origins;
}

} // namespace pcl_gpf
