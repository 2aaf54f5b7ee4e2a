// SPDX-License-Identifier: BSD-3-Clause
#include "face_edge.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

/** Turns the direction to where the own face is. \return false where it lies on both sides */
bool
turnInward(const FaceView& view, double reach, FaceEdge& edge)
{
  const Eigen::Vector3f along_edge = view.normal.cross(edge.inward);
  double one_side = 0, other_side = 0;
  for (const FacePoint& p : view.own) {
    const double distance = edge.distanceOf(p.position);
    const double weight = std::max(0.0, 1.0 - std::abs(static_cast<double>(p.position.dot(along_edge))) / (kAlong * reach));
    if (std::abs(distance) < kAcross * reach)
      (distance > 0 ? one_side : other_side) += weight * std::abs(distance);
  }
  if (one_side < other_side) {
    edge.inward = -edge.inward;
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
    return a.position.squaredNorm() < b.position.squaredNorm();
  });
  if (nearest == view.other.end())
    return edge;
  const float nearest_distance = nearest->position.norm(), patch = nearest_distance + kPatch * reach;
  Eigen::Vector3f through = Eigen::Vector3f::Zero(), direction = Eigen::Vector3f::Zero();
  float count = 0;
  for (const FacePoint& p : view.other) {
    const float cosine = p.normal.dot(nearest->normal);
    if (!(std::abs(cosine) > least_cosine) || !(p.position.squaredNorm() <= patch * patch))
      continue;
    through += p.position;
    direction += cosine < 0 ? Eigen::Vector3f(-p.normal) : p.normal;
    count += 1;
  }
  direction.normalize();
  const Eigen::Vector3f across = direction - direction.dot(view.normal) * view.normal;
  const float sine = across.norm();
  if (!(sine > kLeastSine))
    return edge;
  edge.nearest_other = static_cast<double>(nearest_distance);
  edge.inward = across / sine;
  edge.distance = -static_cast<double>(through.dot(direction) / (count * sine));
  edge.found = turnInward(view, static_cast<double>(reach), edge);
  return edge;
}

} // namespace pcl_gpf
