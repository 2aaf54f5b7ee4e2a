// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../kernels/gaps.h"

#include <pcl_gpf/core/cluster_tree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

class GrowingCloud;

/** EAR's base selection. Const, and safe to share between threads. */
class GapSearch {
public:
  /** Memory that a thread uses again for each patch. */
  class Scratch {
    friend class GapSearch;
    std::vector<std::uint32_t> groups_;
    std::vector<Run> runs_;
    std::vector<float> radius_sq_;
    kernels::GapScratch arrays_;
  };

  GapSearch(double edge_sensitivity, bool sign_invariant);

  /** The gaps of greatest priority between each of the points [begin, end) of the cloud and its neighbours, into `gaps`,
   * kGapsOfPoint each.
   *
   * Neighbours are sought within `reach`, or farther where the gap known before is wide, at most within `farthest`. Where no point
   * near has a number of at least `first_new`, gaps stay as they are. */
  void
  widest(const GrowingCloud& cloud, std::size_t begin, std::size_t end, std::uint32_t first_new, float reach, float farthest,
         Scratch& scratch, Gap* gaps) const;

private:
  std::vector<float> edge_factors_; ///< (2 - c)^rho at even steps of c from 1 down to -1
  bool sign_invariant_;
};

} // namespace pcl_gpf
