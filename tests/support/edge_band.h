// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_gpf::test {

/** \brief Density of points on the faces of the unit cube beside its edges, in units of the mean: element k is that between k / 4 and
 * (k + 1) / 4 spacings from the edge, over both faces of all twelve edges but their ends. \param[in] normals tell the faces apart */
inline std::vector<double>
densityBesideCubeEdges(const std::vector<Vector3>& points, const std::vector<Vector3>& normals, std::size_t bins = 32)
{
  constexpr double kEnds = 0.2;
  const double spacing = std::sqrt(6.0 / static_cast<double>(points.size())), bin = 0.25 * spacing;
  std::vector<double> density(bins);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t face = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (std::abs(normals[i][axis]) > std::abs(normals[i][face]))
        face = axis;
    for (std::size_t across = 0; across < 3; ++across) {
      if (across == face)
        continue;
      const double along = points[i][3 - face - across], place = points[i][across];
      const auto k = static_cast<std::size_t>(std::abs(std::min(place, 1 - place)) / bin);
      if (k < bins && along > kEnds && along < 1 - kEnds)
        density[k] += 1.0;
    }
  }
  for (double& d : density) // expected: 24 strips, each a bin wide
    d /= 24 * bin * (1 - 2 * kEnds) / (spacing * spacing);
  return density;
}

/** \brief Width of the empty band beside the edges of the cube, in spacings: the longest stretch whose density is below half of the mean. */
inline double
cubeBand(const std::vector<Vector3>& points, const std::vector<Vector3>& normals)
{
  std::size_t longest = 0, stretch = 0;
  for (const double d : densityBesideCubeEdges(points, normals)) {
    stretch = d < 0.5 ? stretch + 1 : 0;
    longest = std::max(longest, stretch);
  }
  return 0.25 * static_cast<double>(longest);
}

/** \brief Distance to the surface of the unit cube. */
inline double
distanceToUnitCube(const Vector3& p)
{
  double outside_sq = 0, inside = 1;
  for (const double c : p) {
    const double beyond = std::max({-c, c - 1, 0.0});
    outside_sq += beyond * beyond;
    inside = std::min({inside, std::abs(c), std::abs(c - 1)});
  }
  return outside_sq > 0 ? std::sqrt(outside_sq) : inside;
}

} // namespace pcl_gpf::test
