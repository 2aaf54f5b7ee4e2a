// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/triangle.h"

#include <algorithm>

namespace pcl_gpf {
namespace {

constexpr TriangleFeature kEdges[3] = {TriangleFeature::Edge0, TriangleFeature::Edge1, TriangleFeature::Edge2};
constexpr TriangleFeature kCorners[3] = {TriangleFeature::Corner0, TriangleFeature::Corner1, TriangleFeature::Corner2};

TrianglePoint
pointAt(const Position& offset, TriangleFeature feature)
{
  return {offset, dot(offset, offset), feature};
}

/** \brief Nearest point to the origin on edge `k`, which runs from `from` along `edge` to `to`. */
TrianglePoint
nearestOfEdge(const Position& from, const Position& edge, const Position& to, std::size_t k)
{
  const double edge_sq = dot(edge, edge);
  const double projection = -dot(from, edge);
  if (projection <= 0 || edge_sq == 0)
    return pointAt(from, kCorners[k]);
  if (projection >= edge_sq)
    return pointAt(to, kCorners[(k + 1) % 3]);
  return pointAt(addScaled(from, projection / edge_sq, edge), kEdges[k]);
}

/** \brief Whether the height is more than rounding error, so that the normal can be trusted. */
bool
hasArea(const std::array<Position, 3>& edges, double normal_sq)
{
  constexpr double kLeastHeightRatio = 1e-12;
  double longest_sq = 0;
  for (const Position& edge : edges)
    longest_sq = std::max(longest_sq, dot(edge, edge));
  return std::sqrt(normal_sq) > kLeastHeightRatio * longest_sq;
}

} // namespace

TrianglePoint
nearestOfTriangle(const TriangleCorners& corners, const Position& query)
{
  std::array<Position, 3> to_corner; // relative to the query, so that large coordinates cost no digits
  std::array<Position, 3> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    to_corner[k] = subtract(corners[k], query);
    edges[k] = subtract(corners[(k + 1) % 3], corners[k]);
  }
  const Position normal = cross(edges[0], edges[1]);
  const double normal_sq = dot(normal, normal);
  const bool has_area = hasArea(edges, normal_sq);
  bool inside = has_area;
  std::array<bool, 3> beyond{};
  for (std::size_t k = 0; k < 3; ++k) {
    beyond[k] = dot(cross(to_corner[k], edges[k]), normal) <= 0;
    inside = inside && !beyond[k];
  }
  if (inside)
    return pointAt(addScaled({0, 0, 0}, dot(to_corner[0], normal) / normal_sq, normal), TriangleFeature::Face);

  // Only an edge with the query on its outer side can hold the nearest point; without an area every edge may.
  TrianglePoint best;
  bool found = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (has_area && !beyond[k])
      continue;
    const TrianglePoint candidate = nearestOfEdge(to_corner[k], edges[k], to_corner[(k + 1) % 3], k);
    if (!found || candidate.distance_sq < best.distance_sq)
      best = candidate;
    found = true;
  }
  return best;
}

} // namespace pcl_gpf
