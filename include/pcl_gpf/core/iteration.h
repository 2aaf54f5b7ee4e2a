// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace pcl_gpf {

/** \brief What one iteration of an operator did. Lengths are in the normalised frame (LocalFrame) unless a caller converts them. */
struct IterationStats {
  double variance = 0;              ///< sigma^2 used by the E-step of this iteration (eq. 3)
  double next_variance = 0;         ///< sigma^2 after it (eq. 11)
  double mean_movement = 0;         ///< mean |x_new - x_old|
  double max_movement = 0;          ///< max |x_new - x_old|
  double posterior_sum = 0;         ///< N_p, sum of all posteriors (eq. 4); sum of all data weights where no posterior is formed
  std::size_t isolated_points = 0;  ///< points whose data are at most the input point that seeded them; nothing filters them
  double seconds = 0;
};

/** \brief Called between pieces of work with the fraction done in [0, 1]; return false to cancel.
 *
 * Called from the thread that called the filter, never concurrently.
 */
using ProgressCallback = std::function<bool(double fraction)>;

/** \brief For a part of the work that goes from one fraction to another; empty when `progress` is, which must outlive it. */
inline ProgressCallback
partOf(const ProgressCallback& progress, double from, double to)
{
  if (!progress)
    return {};
  return [&progress, from, to](double fraction) { return progress(from + (to - from) * fraction); };
}

} // namespace pcl_gpf
