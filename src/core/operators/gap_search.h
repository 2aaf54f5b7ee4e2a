// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "patches.h"

#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_gpf {

/** The widest gap beside a point v, weighted by the edge that it lies across. */
struct Gap {
  std::array<float, 3> base{0.0f, 0.0f, 0.0f}; ///< b, the middle of v and t
  float clearance_sq = 0.0f;                   ///< C(b)
  float priority = 0.0f;                       ///< (2 - n_v.n_t)^rho C(b); 0 = there is no gap
  std::uint32_t partner = 0;                   ///< number of t in the order of the caller
};

/** EAR's base selection over points in sorted order. Const, and safe to share between threads. */
class GapSearch {
public:
  /** Neighbours beyond this many, the nearest ones, are left out, so that dense places cost no more than others. */
  static constexpr std::size_t kMostNeighbors = 95;

  /** Memory that a thread uses again for each query. */
  class Scratch;

  GapSearch(double edge_sensitivity, bool sign_invariant);

  /** The gap of greatest priority between each of the sorted points [begin, end) and its neighbours, into gaps[k - begin].
   *
   * Neighbours are sought within `reach`, or farther where the gap known before is wide, at most within `farthest`. Where no point
   * near has a number of at least `first_new`, gaps stay as they are. */
  void
  widest(const PointIndex& points, NormalsView normals, std::size_t begin, std::size_t end, std::uint32_t first_new,
         float reach, float farthest, Scratch& scratch, Gap* gaps) const;

private:
  Gap
  widestOf(std::uint32_t v, const std::vector<std::uint32_t>& order, float radius, Scratch& scratch) const;
  float
  edgeFactor(float cosine) const;

  std::vector<float> edge_factors_; ///< (2 - c)^rho at even steps of c from 1 down to -1
  bool sign_invariant_;
};

class GapSearch::Scratch {
  friend class GapSearch;
  static constexpr std::size_t kSize = (kMostNeighbors + 15) / 8 * 8; ///< v itself, and padding to whole groups of 8

  /** Makes the neighbours of candidate `self`. \return how many, `self` not counted */
  std::size_t
  collect(std::size_t self, float radius);

  NearbyPoints candidates_; ///< of several points
  std::vector<float> distance_sq_;
  std::vector<std::uint32_t> chosen_;
  /** Neighbours relative to v, v itself behind them. */
  struct {
    alignas(64) float x[kSize], y[kSize], z[kSize], nx[kSize], ny[kSize], nz[kSize];
    std::uint32_t place[kSize];
  } near_;
};

} // namespace pcl_gpf
