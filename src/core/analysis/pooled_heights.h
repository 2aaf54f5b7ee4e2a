// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

namespace pcl_gpf {

/** \brief Distances of points from the middle of patches, in bins of kPooledHeight / kHeightBins, whatever the side. */
constexpr std::size_t kHeightBins = 42;
constexpr double kPooledHeight = 4.2; ///< standard deviations
using HeightCounts = std::array<double, kHeightBins>;

/** \brief Which is likelier of pooled heights, one sheet or two. */
struct SheetsFit {
  double gain = 0.0;      ///< logarithm of the likelihood of two over one, for each height
  double deviation = 1.0; ///< of the noise of one of two sheets, in the unit of the heights
  double share = 0.0;     ///< of the variance that is due to the gap
};

/** \brief Fits what one sheet may give, and what two.
 *
 * One sheet: normal noise, or any mixture of what even noise along three axes gives on planes of various directions. Two: sheets of equal
 * density with normal noise or with even noise on planes of one direction. All with a share of points anywhere, at any scale near 1.
 * \param[in] points_per_patch by which a patch of second degree follows the noise
 * Cost: about a millisecond.
 */
SheetsFit
fitSheets(const HeightCounts& counts, double points_per_patch);

} // namespace pcl_gpf
