// SPDX-License-Identifier: BSD-3-Clause
#include "noisy_cloud.h"

#include <pcl_gpf/core/analysis/synthetic_noise.h>
#include <pcl_gpf/core/sampling.h>

#include <algorithm>
#include <stdexcept>

namespace pcl_gpf::quality {

namespace {

constexpr const char* kKindNames[] = {"gaussian", "normal", "uniform", "scanner"};

Position
centreOf(const BoundingBox& box)
{
  return {0.5 * (box.min[0] + box.max[0]), 0.5 * (box.min[1] + box.max[1]), 0.5 * (box.min[2] + box.max[2])};
}

/** Standard deviations along the ray are proportional to distance^2 / max(cosine, 1/4), a third of it across; scaled so
 * that the mean square over points and axes is level^2. */
void
addScannerNoise(NoisyCloud& cloud, double level, std::uint64_t seed)
{
  constexpr double kAcross = 1.0 / 3, kLeastCosine = 0.25, kViewDistance = 1.5;
  const BoundingBox box = cloud.model.surface->box();
  const Position eye = addScaled(centreOf(box), kViewDistance * box.diagonal(), normalized({0.6, -0.5, 0.7}));
  std::vector<double> deviations;
  double squares = 0;
  for (const SurfaceSample& s : cloud.clean) {
    const Position ray = subtract(s.point, eye);
    const double cosine = std::abs(dot(normalized(ray), s.normal));
    deviations.push_back(dot(ray, ray) / std::max(cosine, kLeastCosine));
    squares += deviations.back() * deviations.back() * (1 + 2 * kAcross * kAcross) / 3;
  }
  const double scale = level / std::sqrt(squares / static_cast<double>(cloud.clean.size()));
  SplitMix64 random(seed);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double along = scale * deviations[i];
    const Position ray = normalized(subtract(cloud.clean[i].point, eye));
    Position step;
    for (double& c : step)
      c = kAcross * along * random.normal();
    const double wanted = along * random.normal();
    cloud.points[i] = addScaled(addScaled(cloud.points[i], 1, step), wanted - dot(step, ray), ray);
  }
}

void
replaceByOutliers(NoisyCloud& cloud, double share, std::uint64_t seed)
{
  constexpr double kBoxFactor = 1.2, kLeastHalfWidth = 0.1; // the latter in diagonals, for flat models
  const auto count = static_cast<std::size_t>(std::llround(share * static_cast<double>(cloud.points.size())));
  const BoundingBox box = cloud.model.surface->box();
  const Position centre = centreOf(box);
  SplitMix64 random(seed);
  for (const std::uint32_t i : randomSubset(cloud.points.size(), count, random.next())) {
    cloud.is_outlier[i] = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double half =
          std::max(0.5 * kBoxFactor * (box.max[axis] - box.min[axis]), kLeastHalfWidth * box.diagonal());
      cloud.points[i][axis] = centre[axis] + (2 * random.uniform() - 1) * half;
    }
  }
}

} // namespace

NoiseKind
noiseKind(const std::string& name)
{
  for (std::size_t i = 0; i < std::size(kKindNames); ++i)
    if (name == kKindNames[i])
      return static_cast<NoiseKind>(i);
  throw std::invalid_argument("there is no noise \"" + name + "\"; there are gaussian, normal, uniform and scanner");
}

const char*
nameOf(NoiseKind kind)
{
  return kKindNames[static_cast<std::size_t>(kind)];
}

NoisyCloud
makeNoisyCloud(const Model& model, std::size_t count, const NoiseSpec& spec)
{
  NoisyCloud cloud;
  cloud.model = model;
  cloud.spec = spec;
  cloud.clean = sampleModel(model, count, spec.seed);
  cloud.spacing = spacingOf(model, count);
  cloud.is_outlier.assign(count, 0);
  std::vector<Position> normals;
  for (const SurfaceSample& s : cloud.clean) {
    cloud.points.push_back(s.point);
    normals.push_back(s.normal);
  }
  const double level = spec.percent / 100 * model.surface->diagonal();
  SyntheticNoise noise;
  noise.seed = spec.seed;
  if (spec.kind == NoiseKind::Scanner) {
    if (level > 0)
      addScannerNoise(cloud, level, SplitMix64(spec.seed + 1).next());
  } else {
    (spec.kind == NoiseKind::Gaussian ? noise.gaussian
     : spec.kind == NoiseKind::Normal ? noise.along_normal
                                      : noise.uniform) = level;
    addNoise(noise, cloud.points, normals);
  }
  if (spec.outliers > 0)
    replaceByOutliers(cloud, spec.outliers, SplitMix64(spec.seed + 2).next());
  return cloud;
}

} // namespace pcl_gpf::quality
