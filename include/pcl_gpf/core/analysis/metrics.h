// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/export.h>

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Statistics of the distances between a cloud and a reference, in the unit of the distances. */
struct DistanceSummary {
  std::size_t count = 0;    ///< distances that are finite; all figures are over these, 0 if there is none
  std::size_t left_out = 0; ///< distances that are not finite (rows of points that were not)
  double mean = 0;          ///< mean |d|
  double rms = 0;           ///< square root of the mean d^2
  double p95 = 0;           ///< 95th percentile of |d|, interpolated linearly between ranks
  double max = 0;           ///< largest |d|
  double signed_mean = 0;   ///< mean d: below 0 = the cloud lies inside the reference; equals mean for unsigned distances
};

/** \brief Sums up distances with or without sign, any of which may be NaN. Cost: linear. */
PCL_GPF_CORE_EXPORT DistanceSummary
summarizeDistances(const std::vector<double>& distances);

/** \brief |a[i] - b[i]| row by row; NaN where either point is not measurable (isMeasurable()).
 *
 * \throws InvalidParameter if the sizes differ
 */
PCL_GPF_CORE_EXPORT std::vector<double>
rowDistances(const std::vector<Position>& a, const std::vector<Position>& b);

} // namespace pcl_gpf
