// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace pcl_gpf {

/** A point of a strip: how far from the edge, and its weight; ties go by place. */
struct StripPoint {
  double distance, weight;
  std::uint32_t place;

  bool
  operator<(const StripPoint& other) const
  {
    return distance != other.distance ? distance < other.distance : place < other.place;
  }
};

/** The points of a face beside an edge, in the order of their distance from it. */
struct EdgeStrip {
  static constexpr double kStay = 0.75; ///< points that stay on the edge, in spacings

  std::vector<StripPoint> points; ///< weights summed up from the first
  double length = 0;              ///< as far as there are points
  double spacing = 0;             ///< of the cloud's points in it

  /** Where a point would be if the points lay evenly, less those that stay on the edge. */
  double
  placeOf(const StripPoint& point) const
  {
    const auto next = std::lower_bound(points.begin(), points.end(), point);
    const double before = next == points.begin() ? 0.0 : std::prev(next)->weight;
    const double stay = kStay * spacing;
    return (length * before / points.back().weight - stay) * length / std::max(length - stay, spacing);
  }
};

} // namespace pcl_gpf
