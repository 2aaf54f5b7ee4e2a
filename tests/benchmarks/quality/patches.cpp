// SPDX-License-Identifier: BSD-3-Clause
#include "patches.h"

#include <algorithm>
#include <limits>

namespace pcl_gpf::quality {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double
between(SplitMix64& random, double low, double high)
{
  return low + random.uniform() * (high - low);
}

} // namespace

RectanglePatch::RectanglePatch(std::size_t axis, double level, Planar low, Planar high, double sign,
                               std::vector<Circle> circles, std::vector<Hole> holes)
    : axis_(axis)
    , u_(axis == 0 ? 1 : 0)
    , v_(axis == 2 ? 1 : 2)
    , level_(level)
    , sign_(sign)
    , low_(low)
    , high_(high)
    , circles_(std::move(circles))
    , holes_(std::move(holes))
{
}

double
RectanglePatch::area() const
{
  double area = (high_[0] - low_[0]) * (high_[1] - low_[1]);
  for (const Circle& c : circles_)
    area -= kPi * c.radius * c.radius;
  for (const Hole& h : holes_)
    area -= (h.high[0] - h.low[0]) * (h.high[1] - h.low[1]);
  return area;
}

bool
RectanglePatch::holds(const Planar& q) const
{
  const auto in_circle = [&](const Circle& c) { return std::hypot(q[0] - c.centre[0], q[1] - c.centre[1]) < c.radius; };
  const auto in_hole = [&](const Hole& h) {
    return q[0] > h.low[0] && q[0] < h.high[0] && q[1] > h.low[1] && q[1] < h.high[1];
  };
  return std::none_of(circles_.begin(), circles_.end(), in_circle) &&
         std::none_of(holes_.begin(), holes_.end(), in_hole);
}

void
RectanglePatch::sample(SplitMix64& random, Position& point, Position& normal) const
{
  Planar q;
  do
    q = {between(random, low_[0], high_[0]), between(random, low_[1], high_[1])};
  while (!holds(q));
  point[axis_] = level_;
  point[u_] = q[0];
  point[v_] = q[1];
  normal = normalAt(point);
}

double
RectanglePatch::distance(const Position& p) const
{
  const Planar q = {p[u_], p[v_]};
  for (const Hole& h : holes_)
    if (q[0] > h.low[0] && q[0] < h.high[0] && q[1] > h.low[1] && q[1] < h.high[1])
      return kInfinity;
  double aside = std::hypot(q[0] - std::clamp(q[0], low_[0], high_[0]), q[1] - std::clamp(q[1], low_[1], high_[1]));
  for (const Circle& c : circles_) {
    const double from_centre = std::hypot(q[0] - c.centre[0], q[1] - c.centre[1]);
    if (from_centre < c.radius)
      aside = c.radius - from_centre;
  }
  return std::hypot(aside, p[axis_] - level_);
}

Position
RectanglePatch::normalAt(const Position&) const
{
  Position normal = {0, 0, 0};
  normal[axis_] = sign_;
  return normal;
}

double
CylinderPatch::area() const
{
  return 2 * kPi * radius_ * (high_ - low_);
}

void
CylinderPatch::sample(SplitMix64& random, Position& point, Position& normal) const
{
  const double angle = between(random, 0, 2 * kPi), c = std::cos(angle), s = std::sin(angle);
  point = {centre_[0] + radius_ * c, centre_[1] + radius_ * s, between(random, low_, high_)};
  normal = {sign_ * c, sign_ * s, 0};
}

double
CylinderPatch::distance(const Position& p) const
{
  const double from_axis = std::hypot(p[0] - centre_[0], p[1] - centre_[1]);
  return std::hypot(from_axis - radius_, p[2] - std::clamp(p[2], low_, high_));
}

Position
CylinderPatch::normalAt(const Position& p) const
{
  const Position n = normalized({p[0] - centre_[0], p[1] - centre_[1], 0});
  return {sign_ * n[0], sign_ * n[1], 0};
}

double
DiskPatch::area() const
{
  return kPi * radius_ * radius_;
}

void
DiskPatch::sample(SplitMix64& random, Position& point, Position& normal) const
{
  const double angle = between(random, 0, 2 * kPi), from_centre = radius_ * std::sqrt(random.uniform());
  point = {centre_[0] + from_centre * std::cos(angle), centre_[1] + from_centre * std::sin(angle), level_};
  normal = normalAt(point);
}

double
DiskPatch::distance(const Position& p) const
{
  const double from_centre = std::hypot(p[0] - centre_[0], p[1] - centre_[1]);
  return std::hypot(std::max(from_centre - radius_, 0.0), p[2] - level_);
}

double
CapPatch::area() const
{
  return 2 * kPi * radius_ * height_;
}

void
CapPatch::sample(SplitMix64& random, Position& point, Position& normal) const
{
  const double up = between(random, 1 - height_ / radius_, 1), angle = between(random, 0, 2 * kPi);
  const double aside = std::sqrt(std::max(1 - up * up, 0.0));
  normal = {aside * std::cos(angle), aside * std::sin(angle), up};
  point = addScaled(centre_, radius_, normal);
}

double
CapPatch::distance(const Position& p) const
{
  const Position v = subtract(p, centre_);
  const double from_centre = length(v), rim_up = radius_ - height_;
  if (height_ >= 2 * radius_ || v[2] * radius_ >= rim_up * from_centre)
    return std::abs(from_centre - radius_);
  const double rim_radius = std::sqrt(radius_ * radius_ - rim_up * rim_up);
  return std::hypot(std::hypot(v[0], v[1]) - rim_radius, v[2] - rim_up);
}

Position
CapPatch::normalAt(const Position& p) const
{
  return normalized(subtract(p, centre_));
}

double
TorusPatch::area() const
{
  return 4 * kPi * kPi * ring_ * tube_;
}

void
TorusPatch::sample(SplitMix64& random, Position& point, Position& normal) const
{
  double around_tube, from_axis;
  do { // the outer half has more area
    around_tube = between(random, 0, 2 * kPi);
    from_axis = ring_ + tube_ * std::cos(around_tube);
  } while (random.uniform() * (ring_ + tube_) > from_axis);
  const double angle = between(random, 0, 2 * kPi);
  point = {from_axis * std::cos(angle), from_axis * std::sin(angle), tube_ * std::sin(around_tube)};
  normal = normalAt(point);
}

double
TorusPatch::distance(const Position& p) const
{
  return std::abs(std::hypot(std::hypot(p[0], p[1]) - ring_, p[2]) - tube_);
}

Position
TorusPatch::normalAt(const Position& p) const
{
  const Position ring = normalized({p[0], p[1], 0});
  return normalized(addScaled(p, -ring_, ring));
}

} // namespace pcl_gpf::quality
