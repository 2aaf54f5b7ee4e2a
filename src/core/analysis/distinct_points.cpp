// SPDX-License-Identifier: BSD-3-Clause
#include "distinct_points.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pcl_gpf {

SoaBuffer
distinctPoints(PointsView points)
{
  std::vector<std::array<float, 3>> positions(points.size);
  for (std::size_t i = 0; i < points.size; ++i)
    positions[i] = {points.x[i], points.y[i], points.z[i]};
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  SoaBuffer distinct(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    distinct.x[i] = positions[i][0];
    distinct.y[i] = positions[i][1];
    distinct.z[i] = positions[i][2];
  }
  return distinct;
}

std::size_t
countRepeated(PointsView sorted)
{
  std::size_t count = 0;
  for (std::size_t i = 1; i < sorted.size; ++i)
    count += sorted.x[i] == sorted.x[i - 1] && sorted.y[i] == sorted.y[i - 1] && sorted.z[i] == sorted.z[i - 1];
  return count;
}

} // namespace pcl_gpf
