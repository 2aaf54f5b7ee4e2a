// SPDX-License-Identifier: BSD-3-Clause
#include "bilateral_projection.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_gpf {

namespace {

/** Sums below this are what is left of neighbours that all face elsewhere. */
constexpr double kLeastWeight = 1e-6;
/** Points are projected together while their box is at most this many radii wide. */
constexpr float kWidestBox = 0.25f;
/** A side with less than this share of the other's weight has no input points here. */
constexpr double kLeastShare = 0.3;
/** Of the distances to two planes, for a move onto both: less, and the point lies on one of them already. */
constexpr double kLeastRatio = 0.4;

/** exp(-x) for x >= 0, relative error below 4e-7; 0 beyond 87. Not that of the system, whose last bit differs between machines.
 * Without branches, so that the compiler makes wide code of a loop over it. */
inline float
expMinus(float x)
{
  constexpr float kRounding = 12582912.0f; // 1.5 * 2^23: the sum's low bits are the rounded integer
  const float bounded = x < 87.0f ? x : 87.0f;
  const float shifted = bounded * -1.44269504f + kRounding;
  const float n = shifted - kRounding;
  const float r = (-bounded - n * 0.693359375f) - n * -2.12194440e-4f;
  float p = 1.0f / 720;
  p = p * r + 1.0f / 120;
  p = p * r + 1.0f / 24;
  p = p * r + 1.0f / 6;
  p = p * r + 0.5f;
  p = p * r + 1.0f;
  p = p * r + 1.0f;
  std::uint32_t exponent = 0, bits = 0;
  std::memcpy(&exponent, &shifted, sizeof exponent);
  std::memcpy(&bits, &p, sizeof bits);
  bits += exponent << 23;
  std::memcpy(&p, &bits, sizeof p);
  return x < 87.0f ? p : 0.0f;
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
, edge_cosine_(std::cos(angle))
, sign_invariant_(sign_invariant)
{}

BilateralProjection::Side
BilateralProjection::sumUp(const std::array<float, 3>& b, const std::array<float, 3>& normal, Scratch& s) const
{
  const NearbyPoints& q = s.near_;
  const std::size_t count = q.size();
  const float* distance_weight = s.distance_weight_.data();
  float* weights = s.weight_.data();
  for (std::size_t k = 0; k < count; ++k) {
    const float cosine = normal[0] * q.nx[k] + normal[1] * q.ny[k] + normal[2] * q.nz[k];
    const float aligned = sign_invariant_ ? std::abs(cosine) : cosine;
    const float turn = (1.0f - aligned) * angle_falloff_;
    weights[k] = distance_weight[k] * expMinus(turn * turn);
  }
  Side side;
  float largest = 0.0f;
  for (std::size_t k = 0; k < count; ++k) {
    const float weight = weights[k];
    if (!(weight > 0.0f))
      continue;
    const float cosine = normal[0] * q.nx[k] + normal[1] * q.ny[k] + normal[2] * q.nz[k];
    const float signed_weight = sign_invariant_ && cosine < 0.0f ? -weight : weight;
    const float above = (b[0] - q.x[k]) * q.nx[k] + (b[1] - q.y[k]) * q.ny[k] + (b[2] - q.z[k]) * q.nz[k];
    side.weight += weight;
    side.offset += signed_weight * above;
    side.normal[0] += signed_weight * q.nx[k];
    side.normal[1] += signed_weight * q.ny[k];
    side.normal[2] += signed_weight * q.nz[k];
    if (weight > largest) {
      largest = weight;
      side.nearest = q.places[k];
    }
  }
  const double length = std::sqrt(side.normal[0] * side.normal[0] + side.normal[1] * side.normal[1] + side.normal[2] * side.normal[2]);
  if (!(length > kLeastWeight)) {
    side.weight = 0.0;
    return side;
  }
  side.offset /= side.weight;
  for (double& n : side.normal)
    n /= length;
  return side;
}

ProjectedPoint
BilateralProjection::projectOne(const Query& query, Scratch& s) const
{
  const std::array<float, 3>& b = query.position;
  s.distance_sq_.resize(s.candidates_.size());
  for (std::size_t k = 0; k < s.distance_sq_.size(); ++k) {
    const float dx = b[0] - s.candidates_.x[k], dy = b[1] - s.candidates_.y[k], dz = b[2] - s.candidates_.z[k];
    s.distance_sq_[k] = dx * dx + dy * dy + dz * dz;
  }
  const std::size_t count = s.near_.select(s.candidates_, s.distance_sq_, radius_ * radius_);
  s.distance_weight_.resize(count);
  s.weight_.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    s.distance_weight_[k] = expMinus(s.distance_sq_[k] * distance_falloff_);
  const Side a = sumUp(b, query.first, s), c = sumUp(b, query.second, s);
  // Near a corner a face that ends there must not go on as a sheet of new points that gave each other their normals.
  const double least_weight = std::max(kLeastWeight, kLeastShare * std::max(a.weight, c.weight));
  const bool a_counts = a.weight > least_weight, c_counts = c.weight > least_weight;
  if (!a_counts && !c_counts)
    return {b, query.first, 0, false};
  const bool take_a = a_counts && (!c_counts || std::abs(a.offset) <= std::abs(c.offset));
  const Side& side = take_a ? a : c;
  std::array<double, 3> move{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    move[axis] = -side.offset * side.normal[axis];
  if (a_counts && c_counts)
    moveOntoEdge(a, c, query.longest_move, move);
  ProjectedPoint result{b, {}, side.nearest, true};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.normal[axis] = static_cast<float>(side.normal[axis]);
    result.position[axis] = static_cast<float>(b[axis] + move[axis]);
  }
  return result;
}

/** The shortest move onto both planes, if they meet at an angle and near enough. */
void
BilateralProjection::moveOntoEdge(const Side& a, const Side& c, double longest, std::array<double, 3>& move) const
{
  double cosine = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cosine += a.normal[axis] * c.normal[axis];
  if ((sign_invariant_ ? std::abs(cosine) : cosine) > edge_cosine_ || !(cosine * cosine < 0.97))
    return;
  const double lesser = std::min(std::abs(a.offset), std::abs(c.offset)), larger = std::max(std::abs(a.offset), std::abs(c.offset));
  if (lesser < kLeastRatio * larger)
    return;
  const double scale = 1.0 / (1.0 - cosine * cosine);
  const double along_a = (a.offset - cosine * c.offset) * scale, along_c = (c.offset - cosine * a.offset) * scale;
  std::array<double, 3> onto{};
  double length_sq = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    onto[axis] = -(along_a * a.normal[axis] + along_c * c.normal[axis]);
    length_sq += onto[axis] * onto[axis];
  }
  if (length_sq <= longest * longest)
    move = onto;
}

void
BilateralProjection::project(const std::vector<Query>& queries, Scratch& scratch, ProjectedPoint* results) const
{
  const auto position = [&](std::size_t k) { return queries[k].position; };
  forPatches(0, queries.size(), kWidestBox * radius_, position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
    scratch.candidates_.fill(points_, normals_, box, radius_);
    for (std::size_t k = first; k < last; ++k)
      results[k] = projectOne(queries[k], scratch);
  });
}

} // namespace pcl_gpf
