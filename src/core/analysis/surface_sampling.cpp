// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/triangle.h"

#include <pcl_gpf/core/analysis/surface_sampling.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>

#include <algorithm>

namespace pcl_gpf {
namespace {

TriangleCorners
cornersOf(const std::vector<double>& vertices, const std::uint32_t* triangle)
{
  TriangleCorners corners;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[k][axis] = vertices[3 * std::size_t{triangle[k]} + axis];
  return corners;
}

/** \brief Sum of the doubled areas of triangles 0 .. t, for every t. */
std::vector<double>
cumulatedAreas(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles)
{
  std::vector<double> areas(triangles.size() / 3);
  double sum = 0;
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const TriangleCorners p = cornersOf(vertices, &triangles[3 * t]);
    sum += length(cross(subtract(p[1], p[0]), subtract(p[2], p[0])));
    areas[t] = sum;
  }
  if (!(sum > 0) || !std::isfinite(sum))
    throw UnsuitableData("the mesh has no area to take samples from");
  return areas;
}

} // namespace

std::vector<Position>
sampleSurface(const std::vector<double>& vertices,
              const std::vector<std::uint32_t>& triangles,
              std::size_t count,
              std::uint64_t seed)
{
  const std::vector<double> areas = cumulatedAreas(vertices, triangles);
  SplitMix64 random(seed);
  std::vector<Position> samples(count);
  for (Position& sample : samples) {
    const auto found = std::upper_bound(areas.begin(), areas.end(), random.uniform() * areas.back());
    const auto t = static_cast<std::size_t>(std::min(found, areas.end() - 1) - areas.begin());
    const TriangleCorners p = cornersOf(vertices, &triangles[3 * t]);
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1) { // the other half of the parallelogram
      u = 1 - u;
      v = 1 - v;
    }
    sample = addScaled(addScaled(p[0], u, subtract(p[1], p[0])), v, subtract(p[2], p[0]));
  }
  return samples;
}

} // namespace pcl_gpf
