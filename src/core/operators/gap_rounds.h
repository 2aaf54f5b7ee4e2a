// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../merged_points.h"
#include "gpf_points.h"

#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/operators/gpf_parameters.h>

#include <cstddef>

namespace pcl_gpf {

/** What a round of gap filling works on: the recursion's points and data. */
template <typename Real>
struct GapRound {
  const GPFParameters& parameters;
  const MergedPoints& merged; ///< data where balls hold many points; empty: the points themselves
  const NeighborSearch& search;
  std::size_t threads;
};

/** Spreads X from the edges into the empty bands beside them (movesIntoGaps()), then takes the points that were moved onto their face
 * again: the mean normal, then the mean plane of the data in the ball h / 2 that face the same way. The others stay to the last bit. */
template <typename Real>
IterationStats
runGapRound(const GapRound<Real>& round, GPFPoints<Real>& cloud);

} // namespace pcl_gpf
