// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/local_frame.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** The larger of `noises` times the noise and `spacings` times the spacing, and which of the two it was. */
ParameterOrigin
lengthFromScale(const char* name, const CloudScale& scale, double noises, const char* noise_reason, double spacings,
                const char* spacing_reason)
{
  const bool noisy = noises * scale.noise > spacings * scale.spacing;
  return {name, noisy ? noises * scale.noise : spacings * scale.spacing, "estimated", noisy ? noise_reason : spacing_reason};
}

void
fill(double& value, ParameterOrigin estimate, std::vector<ParameterOrigin>& origins)
{
  if (value > 0.0)
    estimate = {estimate.name, value, "user", ""};
  value = estimate.value;
  origins.push_back(std::move(estimate));
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
  const double apparent_spacing = estimateSpacing(points, number_of_threads);
  scale.noise = estimateNoise(points, apparent_spacing, number_of_threads);
  scale.spacing = spacingWithoutNoise(apparent_spacing, scale.noise);
  return scale;
}

std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, PlaneNormalsParameters& normals, BilateralNormalsParameters& bilateral,
                   GPFParameters& gpf)
{
  std::vector<ParameterOrigin> origins;
  fill(normals.radius, lengthFromScale("normals.radius", scale, 4.0, "4 x noise", 3.0, "3 x spacing"), origins);
  if (bilateral.neighbors == 0)
    fill(bilateral.radius, lengthFromScale("bilateral.radius", scale, 8.0, "8 x noise", 6.0, "6 x spacing"), origins);
  const bool paper = gpf.variance_update == VarianceUpdate::Paper && gpf.posterior_normalization;
  if (paper)
    fill(gpf.support_radius, {"gpf.support_radius", 8.0 * scale.h0, "preset", "8 x h0, within the paper's 3 .. 12"}, origins);
  else
    fill(gpf.support_radius, lengthFromScale("gpf.support_radius", scale, 11.0, "11 x noise", 8.0, "8 x spacing"), origins);
  return origins;
}

} // namespace pcl_gpf
