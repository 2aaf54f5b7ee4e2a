// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_patch.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <array>
#include <vector>

namespace pcl_gpf {

/** \brief A cloud, every 8th of its points, every 64th, ... in Hilbert order, so that each is spread like the whole.
 *
 * A ball of any size holds a few hundred to a few thousand points of one of them. Cost: a seventh of a tree.
 */
class ThinnedClouds {
public:
  /** \param[in] points must outlive this object */
  ThinnedClouds(const PointIndex& points, std::size_t threads);

  /** \brief Number of clouds; 0 is the whole one. */
  std::size_t
  size() const
  {
    return 1 + thinned_.size();
  }
  /** \brief Points of cloud `level` within `radius` of `center`, relative to it. `runs` is storage to be used again. */
  void
  collect(std::size_t level,
          const std::array<float, 3>& center,
          double radius,
          std::vector<Run>& runs,
          std::vector<Offset>& found) const;

private:
  struct Cloud {
    SoaBuffer points;
    ClusterTree tree;
  };
  const PointIndex& whole_;
  std::vector<Cloud> thinned_;
};

} // namespace pcl_gpf
