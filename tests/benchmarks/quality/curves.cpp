// SPDX-License-Identifier: BSD-3-Clause
#include "curves.h"

#include <algorithm>
#include <limits>

namespace pcl_gpf::quality {

Curve
Curve::segment(const Position& from, const Position& to, const Position& outward)
{
  Curve curve;
  curve.start_ = from;
  curve.end_ = to;
  curve.outward_ = outward;
  return curve;
}

Curve
Curve::circle(const Position& centre, double radius, double outward_along_radius, double outward_up)
{
  Curve curve;
  curve.start_ = centre;
  curve.radius_ = radius;
  curve.outward_ = {outward_along_radius, 0, outward_up};
  return curve;
}

double
Curve::distance(const Position& p) const
{
  const Position v = subtract(p, start_);
  if (radius_ > 0)
    return std::hypot(std::hypot(v[0], v[1]) - radius_, v[2]);
  const Position along = subtract(end_, start_);
  const double t = std::clamp(dot(v, along) / dot(along, along), 0.0, 1.0);
  return length(addScaled(v, -t, along));
}

std::vector<BoundarySample>
Curve::samples(double step) const
{
  std::vector<BoundarySample> samples;
  if (radius_ > 0) {
    constexpr double kFullTurn = 6.28318530717958647692;
    const auto count = std::max<std::size_t>(8, static_cast<std::size_t>(kFullTurn * radius_ / step) + 1);
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = kFullTurn * static_cast<double>(i) / static_cast<double>(count);
      const Position radial = {std::cos(angle), std::sin(angle), 0};
      samples.push_back({addScaled(start_, radius_, radial),
                         {-radial[1], radial[0], 0},
                         {outward_[0] * radial[0], outward_[0] * radial[1], outward_[2]}});
    }
    return samples;
  }
  const Position along = subtract(end_, start_);
  const auto count = std::max<std::size_t>(2, static_cast<std::size_t>(length(along) / step) + 1);
  for (std::size_t i = 0; i < count; ++i)
    samples.push_back({addScaled(start_, static_cast<double>(i) / static_cast<double>(count - 1), along),
                       normalized(along), outward_});
  return samples;
}

double
distanceToCurves(const std::vector<Curve>& curves, const Position& p)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Curve& curve : curves)
    least = std::min(least, curve.distance(p));
  return least;
}

std::vector<BoundarySample>
sampleCurves(const std::vector<Curve>& curves, double step)
{
  std::vector<BoundarySample> all;
  for (const Curve& curve : curves) {
    const std::vector<BoundarySample> of_one = curve.samples(step);
    all.insert(all.end(), of_one.begin(), of_one.end());
  }
  return all;
}

} // namespace pcl_gpf::quality
