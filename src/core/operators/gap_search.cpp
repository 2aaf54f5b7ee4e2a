// SPDX-License-Identifier: BSD-3-Clause
#include "gap_search.h"

#include "../kernels/kernels.h"
#include "growing_cloud.h"
#include "patches.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Two points whose normals are parallel within 45 degrees, one above the other, lie on two sheets: nothing is missing between. */
constexpr float kParallel = 0.70710678f;
constexpr float kSteepSq = 0.5f;
/** Normals that face apart more than this belong to the two sides of a sheet, not to an edge. */
constexpr float kOpposite = -0.9f;
/** Points are searched together while their box is at most this many times the reach wide; those of one descent into the tree while
 * theirs is so many. */
constexpr float kWidestBox = 1.6f, kWidestDescent = 5.0f;
/** Neighbours are sought within at least this many clearances of the gap known before, so that points across a wide one are found, and
 * within at most so many, so that a dense edge costs no more than other places. */
constexpr float kLeastClearances = 3.0f, kMostClearances = 5.0f;

bool
holdsNumberFrom(const std::vector<Run>& runs, const std::uint32_t* numbers, std::uint32_t first)
{
  for (const Run run : runs) {
    bool found = false;
    for (std::uint32_t j = run.begin; j < run.end; ++j)
      found |= numbers[j] >= first;
    if (found)
      return true;
  }
  return false;
}

} // namespace

GapSearch::GapSearch(double edge_sensitivity, bool sign_invariant)
: edge_factors_(kernels::kEdgeFactorSteps + 2), sign_invariant_(sign_invariant)
{
  // A table, because pow() of the system need not give the same bits everywhere, and is slow.
  for (std::size_t i = 0; i < edge_factors_.size(); ++i)
    edge_factors_[i] = static_cast<float>(std::pow(1.0 + 2.0 * static_cast<double>(i) / kernels::kEdgeFactorSteps, edge_sensitivity));
}

void
GapSearch::widest(const GrowingCloud& cloud, std::size_t begin, std::size_t end, std::uint32_t first_new, float reach,
                  float farthest, Scratch& scratch, Gap* gaps) const
{
  const auto position = [&](std::size_t k) { return cloud.position(k); };
  std::vector<float>& radius_sq = scratch.radius_sq_;
  radius_sq.resize(end - begin);
  for (std::size_t k = begin; k < end; ++k) {
    const float free = std::sqrt(gaps[kGapsOfPoint * (k - begin)].clearance_sq);
    const float radius = std::min(farthest, std::clamp(reach, kLeastClearances * free, kMostClearances * free));
    radius_sq[k - begin] = radius * radius;
  }
  const auto largest = [&](std::size_t first, std::size_t last) {
    return *std::max_element(radius_sq.data() + (first - begin), radius_sq.data() + (last - begin));
  };
  kernels::WidestGaps a;
  a.points = cloud.positions();
  a.normals = cloud.normals();
  a.numbers = cloud.numbers();
  a.sign_invariant = sign_invariant_;
  a.parallel = kParallel;
  a.steep_sq = kSteepSq;
  a.opposite = kOpposite;
  a.edge_factors = edge_factors_.data();
  a.largest_factor = sign_invariant_ ? edge_factors_[kernels::kEdgeFactorSteps / 2] : edge_factors_[kernels::kEdgeFactorSteps];
  a.scratch = &scratch.arrays_;
  forPatches(begin, end, kWidestDescent * reach, position, [&](std::size_t wide_first, std::size_t wide_last, const FloatBox& wide_box) {
    cloud.tree().collectGroups(wide_box, std::sqrt(largest(wide_first, wide_last)), scratch.groups_);
    forPatches(wide_first, wide_last, kWidestBox * reach, position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
      a.largest_radius_sq = largest(first, last);
      scratch.runs_.clear();
      cloud.tree().collectRuns(scratch.groups_, box, std::sqrt(a.largest_radius_sq), scratch.runs_);
      if (!holdsNumberFrom(scratch.runs_, a.numbers, first_new))
        return;
      std::size_t candidates = 0;
      for (const Run run : scratch.runs_)
        candidates += run.end - run.begin;
      scratch.arrays_.reserve(candidates);
      a.runs = scratch.runs_.data();
      a.run_count = scratch.runs_.size();
      a.first = first;
      a.last = last;
      a.box = box;
      a.radius_sq = radius_sq.data() + (first - begin);
      a.gaps = gaps + kGapsOfPoint * (first - begin);
      kernels::active().widest_gaps(a);
    });
  });
}

} // namespace pcl_gpf
