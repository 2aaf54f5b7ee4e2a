// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_gpf {

/** \brief The part of a triangle that holds a point. Edge k runs from corner k to corner (k + 1) mod 3. */
enum class TriangleFeature : std::uint8_t { Face, Edge0, Edge1, Edge2, Corner0, Corner1, Corner2 };

using TriangleCorners = std::array<Position, 3>;

/** \brief A point of a triangle, seen from a query. */
struct TrianglePoint {
  Position offset{0, 0, 0}; ///< point - query
  double distance_sq = 0;
  TriangleFeature feature = TriangleFeature::Face;
};

/** \brief The point of a triangle nearest to `query`; triangles without area are taken as segments or points. */
TrianglePoint
nearestOfTriangle(const TriangleCorners& corners, const Position& query);

} // namespace pcl_gpf
