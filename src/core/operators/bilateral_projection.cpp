// SPDX-License-Identifier: BSD-3-Clause
#include "bilateral_projection.h"

#include <cmath>
#include <cstring>

namespace pcl_gpf {

namespace {

/** Sums below this are what is left of neighbours that all face elsewhere. */
constexpr double kLeastWeight = 1e-6;

/** exp(-x) for x >= 0, relative error below 4e-7; 0 beyond 87. Not that of the system, whose last bit differs between machines. */
float
expMinus(float x)
{
  if (!(x < 87.0f))
    return 0.0f;
  constexpr float kRounding = 12582912.0f; // 1.5 * 2^23: the sum's low bits are the rounded integer
  const float shifted = x * -1.44269504f + kRounding;
  const float n = shifted - kRounding;
  const float r = (-x - n * 0.693359375f) - n * -2.12194440e-4f;
  float p = 1.0f / 720;
  p = p * r + 1.0f / 120;
  p = p * r + 1.0f / 24;
  p = p * r + 1.0f / 6;
  p = p * r + 0.5f;
  p = p * r + 1.0f;
  p = p * r + 1.0f;
  std::int32_t exponent = 0, bits = 0;
  std::memcpy(&exponent, &shifted, sizeof exponent);
  std::memcpy(&bits, &p, sizeof bits);
  bits += static_cast<std::int32_t>(static_cast<std::uint32_t>(exponent) << 23);
  std::memcpy(&p, &bits, sizeof p);
  return p;
}

} // namespace

/** Weighted means seen along one candidate normal. */
struct BilateralProjection::Side {
  double weight = 0;
  double offset = 0; ///< of b above the planes
  std::array<double, 3> normal{0, 0, 0};
  std::uint32_t nearest = 0;
};

BilateralProjection::BilateralProjection(const PointIndex& points, NormalsView normals, double radius, double angle,
                                         bool sign_invariant)
: points_(points)
, normals_(normals)
, radius_(static_cast<float>(radius))
, distance_falloff_(static_cast<float>(4.0 / (radius * radius)))
, angle_falloff_(static_cast<float>(1.0 / (1.0 - std::cos(angle))))
, sign_invariant_(sign_invariant)
{}

BilateralProjection::Side
BilateralProjection::sumUp(const std::array<float, 3>& b, const std::array<float, 3>& normal, const Scratch& s) const
{
  const PointsView p = points_.sorted();
  Side side;
  float largest = -1.0f;
  for (std::size_t k = 0; k < s.near.size(); ++k) {
    const std::uint32_t q = s.near[k];
    const float cosine = normal[0] * normals_.x[q] + normal[1] * normals_.y[q] + normal[2] * normals_.z[q];
    const float sign = sign_invariant_ && cosine < 0.0f ? -1.0f : 1.0f;
    const float turn = (1.0f - sign * cosine) * angle_falloff_;
    const float weight = s.distance_weight[k] * expMinus(turn * turn);
    const float nx = sign * normals_.x[q], ny = sign * normals_.y[q], nz = sign * normals_.z[q];
    const float above = (b[0] - p.x[q]) * nx + (b[1] - p.y[q]) * ny + (b[2] - p.z[q]) * nz;
    side.weight += weight;
    side.offset += weight * above;
    side.normal[0] += weight * nx;
    side.normal[1] += weight * ny;
    side.normal[2] += weight * nz;
    if (weight > largest) {
      largest = weight;
      side.nearest = q;
    }
  }
  side.offset = side.weight > kLeastWeight ? side.offset / side.weight : 0.0;
  return side;
}

ProjectedPoint
BilateralProjection::project(const std::array<float, 3>& b, const std::array<float, 3>& first,
                             const std::array<float, 3>& second, Scratch& s) const
{
  const PointsView p = points_.sorted();
  s.runs.clear();
  s.near.clear();
  s.distance_weight.clear();
  points_.tree().collectRuns({b, b}, radius_, s.runs);
  for (const Run run : s.runs)
    for (std::uint32_t q = run.begin; q < run.end; ++q) {
      const float dx = b[0] - p.x[q], dy = b[1] - p.y[q], dz = b[2] - p.z[q];
      const float distance_sq = dx * dx + dy * dy + dz * dz;
      if (distance_sq < radius_ * radius_) {
        s.near.push_back(q);
        s.distance_weight.push_back(expMinus(distance_sq * distance_falloff_));
      }
    }
  const Side a = sumUp(b, first, s), c = sumUp(b, second, s);
  const bool a_counts = a.weight > kLeastWeight, c_counts = c.weight > kLeastWeight;
  if (!a_counts && !c_counts)
    return {b, first, 0, false};
  const bool take_a = a_counts && (!c_counts || std::abs(a.offset) <= std::abs(c.offset));
  const Side& side = take_a ? a : c;
  const double length = std::sqrt(side.normal[0] * side.normal[0] + side.normal[1] * side.normal[1] + side.normal[2] * side.normal[2]);
  ProjectedPoint result{b, take_a ? first : second, side.nearest, true};
  for (std::size_t axis = 0; axis < 3 && length > 0.0; ++axis) {
    result.normal[axis] = static_cast<float>(side.normal[axis] / length);
    result.position[axis] = static_cast<float>(b[axis] - side.offset * side.normal[axis] / length);
  }
  return result;
}

} // namespace pcl_gpf
