// SPDX-License-Identifier: BSD-3-Clause
#include "positions.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

std::vector<Position>
positionsOf(const CloudCoordinates& coordinates)
{
  std::vector<Position> positions(coordinates.x.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = {coordinates.x[i], coordinates.y[i], coordinates.z[i]};
  return positions;
}

std::vector<Position>
normalsOf(const CloudFile& cloud)
{
  if (!cloud.hasNormals())
    return {};
  return positionsOf({cloud.column(cloud.findField("normal_x")), cloud.column(cloud.findField("normal_y")),
                      cloud.column(cloud.findField("normal_z"))});
}

bool
hasUsableNormal(const CloudFile& cloud)
{
  constexpr double kShortest = 1e-6;
  const std::vector<Position> normals = normalsOf(cloud);
  return std::any_of(normals.begin(), normals.end(), [](const Position& n) {
    const double length = std::hypot(n[0], n[1], n[2]);
    return std::isfinite(length) && length > kShortest;
  });
}

} // namespace pcl_gpf
