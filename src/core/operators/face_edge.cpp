// SPDX-License-Identifier: BSD-3-Clause
#include "face_edge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_gpf {

namespace {

/** The other face's plane is the mean over points at most this share of the reach further away than the nearest of them. */
constexpr float kPatch = 0.2f;
/** How far from an edge its face is looked for, across and along it, as shares of the reach. */
constexpr double kAcross = 0.75, kAlong = 0.25;
/** Largest share of the face beyond the line: more where the face goes on round a corner of the edge. */
constexpr double kMostBeyond = 0.2;
/** Least sine of the angle between two planes that meet in a line. */
constexpr float kLeastSine = 0.1f;

using Vector = Eigen::Vector3f;

Eigen::Map<const Vector>
asVector(const std::array<float, 3>& values)
{
  return Eigen::Map<const Vector>(values.data());
}

/** Turns the direction to where the own face is. \return false where it lies on both sides */
bool
turnInward(const FaceView& view, double reach, FaceEdge& edge)
{
  const Vector along_edge = asVector(view.normal).cross(asVector(edge.inward));
  double one_side = 0, other_side = 0;
  for (const FacePoint& p : view.own) {
    const double distance = edge.distanceOf(p.position);
    const double weight = std::max(0.0, 1.0 - std::abs(static_cast<double>(asVector(p.position).dot(along_edge))) / (kAlong * reach));
    if (std::abs(distance) < kAcross * reach)
      (distance > 0 ? one_side : other_side) += weight * std::abs(distance);
  }
  if (one_side < other_side) {
    for (float& c : edge.inward)
      c = -c;
    edge.distance = -edge.distance;
    std::swap(one_side, other_side);
  }
  return other_side < kMostBeyond * one_side;
}

} // namespace

FaceEdge
nearestEdge(const FaceView& view, float reach, float least_cosine)
{
  FaceEdge edge;
  const auto nearest = std::min_element(view.other.begin(), view.other.end(), [](const FacePoint& a, const FacePoint& b) {
    return asVector(a.position).squaredNorm() < asVector(b.position).squaredNorm();
  });
  if (nearest == view.other.end())
    return edge;
  const float nearest_distance = asVector(nearest->position).norm(), patch = nearest_distance + kPatch * reach;
  Vector through = Vector::Zero(), direction = Vector::Zero();
  float count = 0;
  for (const FacePoint& p : view.other) {
    const Vector position = asVector(p.position), normal = asVector(p.normal);
    const float cosine = normal.dot(asVector(nearest->normal));
    if (!(std::abs(cosine) > least_cosine) || !(position.squaredNorm() <= patch * patch))
      continue;
    through += position;
    direction += cosine < 0 ? Vector(-normal) : normal;
    count += 1;
  }
  direction.normalize();
  const Vector normal = asVector(view.normal), across = direction - direction.dot(normal) * normal;
  const float sine = across.norm();
  if (!(sine > kLeastSine))
    return edge;
  edge.nearest_other = static_cast<double>(nearest_distance);
  Eigen::Map<Vector>(edge.inward.data()) = across / sine;
  edge.distance = -static_cast<double>(through.dot(direction) / (count * sine));
  edge.found = turnInward(view, static_cast<double>(reach), edge);
  return edge;
}

} // namespace pcl_gpf
