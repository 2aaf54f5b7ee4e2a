// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "rimls_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kRadiusNeighbors = 16; // the point itself counted
/** Local radii are kept within this factor of their median: an outlier's ball must not cover the cloud, a pile of
 * duplicates must reach something. */
constexpr float kRadiusSpread = 16.0f;
/** r_i of an even cloud in spacings: sqrt(16 / pi) / 2. */
constexpr double kRadiusInSpacings = 1.1283791670955126;
constexpr std::size_t kPointsPerTask = 1024;

float
medianOf(std::vector<float> values)
{
  values.erase(std::remove(values.begin(), values.end(), 0.0f), values.end());
  if (values.empty())
    return 0.0f;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Half the distance of the 16th nearest point. */
std::vector<float>
localRadii(const PointIndex& points, std::size_t threads)
{
  const PointsView view = points.sorted();
  std::vector<float> radii(view.size);
  parallelBlocks(view.size, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    for (std::size_t i = begin; i < end; ++i) {
      points.tree().nearest(view, {view.x[i], view.y[i], view.z[i]}, kRadiusNeighbors, distances_sq);
      radii[i] = 2.0f * std::sqrt(distances_sq.back() / static_cast<float>(distances_sq.size()));
    }
  });
  return radii;
}

} // namespace

void
validate(const RimlsParameters& p)
{
  checkRange("scale", p.scale, p.scale >= 1.0 && p.scale <= 100.0, "1 .. 100");
  checkRange("radius", p.radius, p.radius >= 0.0, ">= 0, 0 = from scale");
  checkRange("minimum_radius", p.minimum_radius, p.minimum_radius >= 0.0, ">= 0");
  checkRange("sigma_n", p.sigma_n, p.sigma_n >= 1e-3 && p.sigma_n <= 1e6, "0.001 .. 1000000");
  checkRange("sigma_r", p.sigma_r, p.sigma_r == 0.0 || (p.sigma_r >= 1e-3 && p.sigma_r <= 1e6),
             "0 = off, or 0.001 .. 1000000");
  checkRange("fits", p.fits, p.fits >= 1 && p.fits <= 100, "1 .. 100");
  checkRange("maximum_iterations", p.maximum_iterations, p.maximum_iterations >= 1 && p.maximum_iterations <= 1000,
             "1 .. 1000");
  checkRange("accuracy", p.accuracy, p.accuracy > 0.0, "> 0");
  checkRange("minimum_samples", p.minimum_samples, p.minimum_samples >= 1, ">= 1");
  checkRange("domain", p.domain, p.domain > 0.0, "> 0");
}

void
RimlsSurface::Implementation::chooseRadii(std::size_t threads)
{
  if (parameters.radius > 0.0) {
    const double radius = std::max(boundedRadius(parameters.radius), parameters.minimum_radius * parameters.scale);
    radii.assign(index->size(), static_cast<float>(radius));
    spacing = radius / parameters.scale / kRadiusInSpacings;
    return;
  }
  radii = localRadii(*index, threads);
  const float median = medianOf(radii);
  spacing = median / kRadiusInSpacings;
  const float least = std::max(median / kRadiusSpread, static_cast<float>(parameters.minimum_radius));
  const float most = std::max(median * kRadiusSpread, least);
  for (float& radius : radii)
    radius = static_cast<float>(parameters.scale) * std::clamp(radius, least, most);
}

void
RimlsSurface::Implementation::prepare()
{
  const std::size_t threads = resolveThreads(parameters.number_of_threads);
  chooseRadii(threads);
  constexpr float kLeast = 1e-18f; // its square and the inverse of that are floats
  for (float& radius : radii) // with all points in one place any radius does, but none may be 0
    radius = std::max(radius, kLeast);
  samples.points = {index->sorted().x, index->sorted().y, index->sorted().z};
  samples.inverse_sq.assign(radii.size() + kQueryBlock, 1.0f);
  for (std::size_t i = 0; i < radii.size(); ++i)
    samples.inverse_sq[i] = 1.0f / (radii[i] * radii[i]);
  balls.fit(index->sorted(), threads, radii.data());
  largest_radius = radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end());
}

RimlsSurface::RimlsSurface(const RimlsParameters& parameters, PointsView points, NormalsView normals)
: implementation_(std::make_unique<Implementation>())
{
  validate(parameters);
  Implementation& surface = *implementation_;
  surface.parameters = parameters;
  surface.own_index = std::make_unique<PointIndex>(points, parameters.number_of_threads);
  surface.index = surface.own_index.get();
  surface.samples.normals = gather<float>(normals, {}, surface.index->order(), 0.0f);
  surface.prepare();
}

RimlsSurface::RimlsSurface(const RimlsParameters& parameters, const PointIndex& points, NormalsView normals)
: implementation_(std::make_unique<Implementation>())
{
  validate(parameters);
  Implementation& surface = *implementation_;
  surface.parameters = parameters;
  surface.index = &points;
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  surface.samples.normals = gather<float>(normals, {}, order, 0.0f);
  surface.prepare();
}

RimlsSurface::RimlsSurface(RimlsSurface&&) noexcept = default;
RimlsSurface&
RimlsSurface::operator=(RimlsSurface&&) noexcept = default;
RimlsSurface::~RimlsSurface() = default;

double
RimlsSurface::spacing() const
{
  return implementation_->spacing;
}

const PointIndex&
RimlsSurface::points() const
{
  return *implementation_->index;
}

std::vector<float>
RimlsSurface::supportRadii() const
{
  const Implementation& surface = *implementation_;
  std::vector<float> radii(surface.radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k)
    radii[surface.own_index ? surface.index->order()[k] : k] = surface.radii[k];
  return radii;
}

void
RimlsSurface::evaluate(PointsView positions, const ImplicitValues& values) const
{
  implementation_->fitAll(positions, {}, [&](const RimlsFit& fit, std::size_t position, std::size_t i) {
    if (values.value)
      values.value[position] = fit.inside(i) ? fit.value(i) : std::numeric_limits<float>::quiet_NaN();
    if (values.gradient.x) {
      values.gradient.x[position] = fit.gradient().x[i];
      values.gradient.y[position] = fit.gradient().y[i];
      values.gradient.z[position] = fit.gradient().z[i];
    }
    if (values.inside)
      values.inside[position] = fit.inside(i);
  });
}

} // namespace pcl_gpf
