// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl_gpf {

/** \brief Points within a radius of sorted point i, counted until there are more than `enough`. \param[in] runs room that is used again */
inline std::size_t
countBall(const ClusterTree& tree, PointsView sorted, std::size_t i, float radius_sq, std::vector<Run>& runs,
          std::size_t enough = std::numeric_limits<std::size_t>::max())
{
  const std::array<float, 3> centre = {sorted.x[i], sorted.y[i], sorted.z[i]};
  runs.clear();
  tree.collectRuns({centre, centre}, std::sqrt(radius_sq), runs);
  std::size_t held = 0;
  for (std::size_t r = 0; r < runs.size() && held <= enough; ++r)
    for (std::size_t j = runs[r].begin; j < runs[r].end; ++j) {
      const float dx = sorted.x[j] - centre[0], dy = sorted.y[j] - centre[1], dz = sorted.z[j] - centre[2];
      held += dx * dx + dy * dy + dz * dz < radius_sq;
    }
  return held;
}

} // namespace pcl_gpf
