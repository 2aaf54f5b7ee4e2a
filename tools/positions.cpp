// SPDX-License-Identifier: BSD-3-Clause
#include "positions.h"

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

} // namespace pcl_gpf
