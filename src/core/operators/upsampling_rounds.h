// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bilateral_projection.h"
#include "gap_search.h"
#include "growing_cloud.h"

#include <pcl_gpf/core/operators/edge_aware_upsampling.h>
#include <pcl_gpf/core/point_index.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** The parameters with everything that had to be estimated. */
struct UpsamplingPlan {
  std::size_t target = 0;     ///< points in all
  double radius = 0;          ///< R
  double least_clearance = 0; ///< gaps below are left; 0 = only the target counts
  double rounding = 0;        ///< clearances below are none
  double angle = 0;           ///< radians
  double edge_sensitivity = 0;
  bool sign_invariant = true;
  std::size_t threads = 1;
};

/** Edge-aware insertion in rounds.
 *
 * Every point keeps its two widest gaps. A round takes all but the smallest of them by priority (kShareLeft), fills those that can be
 * filled together, and searches again only where it inserted. A gap that is not searched again can only have become smaller, so its old
 * priority is an upper bound.
 */
class UpsamplingRounds {
public:
  /** \param[in] unit_normals in sorted order. Points and parents have their places in `points` as numbers. */
  UpsamplingRounds(const UpsamplingPlan& plan, const PointIndex& points, NormalsView unit_normals);

  /** \return false when the target is reached or nothing is left to fill */
  bool
  step();
  double
  fractionDone() const;
  EdgeAwareUpsamplingResult
  result();

private:
  std::size_t size() const { return input_size_ + parents_.size(); }
  void
  searchGaps();
  /** Of the gaps that are left: the last round has filled, or made smaller, all of a priority from the least that it filled. */
  float
  widestClearance() const;
  bool
  counts(const Gap& gap) const;
  float
  leastPriority() const;
  std::vector<std::uint32_t>
  chooseBases(float least) const;
  /** Leaves the `count` of greatest priority, in the order they have. */
  void
  keepBest(std::vector<std::uint32_t>& chosen, std::size_t count) const;
  void
  fill(const std::vector<std::uint32_t>& chosen);
  /** Puts the points of the last round between the others; only needed when another round follows. */
  void
  joinInserted();

  UpsamplingPlan plan_;
  std::size_t input_size_;
  BilateralProjection projection_;
  GapSearch search_;
  GrowingCloud cloud_;

  std::vector<float> x_, y_, z_, nx_, ny_, nz_;                   ///< of inserted points
  std::vector<std::uint32_t> parents_, first_base_, second_base_; ///< of inserted points
  std::vector<std::uint32_t> filled_; ///< gaps that the last round filled

  std::uint32_t searched_ = 0; ///< numbers of points that have been searched lie below
  float reach_ = 0;          ///< within which partners are sought where gaps are not wide; shrinks with them
  float least_clearance_sq_ = 0;
  double first_priority_ = 0;
  float last_priority_ = 0;
  float least_filled_ = 0; ///< priority, of the gaps filled since the last search
  std::size_t rounds_ = 0;
};

} // namespace pcl_gpf
