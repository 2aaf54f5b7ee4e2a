// SPDX-License-Identifier: BSD-3-Clause
#include "distinct_points.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace pcl_gpf {

namespace {

/** Share of repeated positions from which on copies matter: patches of piles show no noise, and a tenth of the patches decides. */
constexpr double kManyRepeated = 0.02;

bool
coincide(PointsView p, std::size_t i, std::size_t j)
{
  return p.x[i] == p.x[j] && p.y[i] == p.y[j] && p.z[i] == p.z[j];
}

} // namespace

std::vector<std::uint32_t>
differentPoints(PointsView points)
{
  std::vector<std::uint32_t> different(points.size);
  std::iota(different.begin(), different.end(), std::uint32_t{0});
  std::sort(different.begin(), different.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(points.x[a], points.y[a], points.z[a], a) < std::tie(points.x[b], points.y[b], points.z[b], b);
  });
  different.erase(std::unique(different.begin(), different.end(),
                              [&](std::uint32_t a, std::uint32_t b) { return coincide(points, a, b); }),
                  different.end());
  std::sort(different.begin(), different.end());
  return different;
}

SoaBuffer
distinctPoints(PointsView points)
{
  return elementsOf(points, differentPoints(points));
}

bool
repeatsManyPoints(PointsView sorted)
{
  std::size_t count = 0;
  for (std::size_t i = 1; i < sorted.size; ++i)
    count += coincide(sorted, i, i - 1);
  return static_cast<double>(count) > kManyRepeated * static_cast<double>(sorted.size);
}

} // namespace pcl_gpf
