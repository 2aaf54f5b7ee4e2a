// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief What decides where a filtered surface gives way to that of a narrower ball; lengths in the normalised frame. */
struct ThinPartsParameters {
  double noise = 0.0;   ///< standard deviation along the normal, >= 0
  double spacing = 0.0; ///< of the points, > 0

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Places where a filtered surface lies further from the noisy points than noise explains. */
struct ThinParts {
  std::vector<std::uint32_t> places; ///< in the order of points.sorted(), ascending
  std::vector<float> mean_squares;   ///< of the heights about each place
};

/** \brief Finds where two sides of a wall may have been drawn together or a detail taken away: there the heights of the noisy points above
 * the filtered surface have a mean square, in a ball of 2.5 spacings, of more than 2.25 squares of the noise. Balls of fewer than
 * seven points say nothing.
 *
 * Neither signs nor faces take part, so walls between two edges are found, too; stronger noise is, as well (confirmThinParts()).
 * Heights count up to four deviations of those nearby, so that outliers do not decide.
 * \param[in] points the noisy input
 * \param[in] positions, normals the filtered surface in the order of points.sorted(); the positions are given up
 * \throws InvalidParameter
 * Cost: about one iteration of the fine filter.
 */
PCL_GPF_CORE_EXPORT ThinParts
findThinParts(const ThinPartsParameters& parameters, const PointIndex& points, SoaBuffer positions, const SoaBuffer& normals);

/** \brief Those of the places where a narrower filter explains the heights, and noise that is stronger than the cloud's does not.
 *
 * A filter of few points follows noise of any strength s and leaves heights of s^2 / (1 + 3.5 s^2 / spacing^2), no less than s^2 / 4. Where
 * walls were drawn together it leaves those of the cloud's noise, far less than of noise as strong as the heights were. A place is
 * confirmed when less than 0.7 of the former is left within 5 spacings of it; less than 0.45 where the coarse scale, which knows
 * stronger noise from detail (selectFineScale()), saw no detail, and nothing there that is over 20 squares of the noise.
 * \param[in] found what findThinParts() found before
 * \param[in] positions, normals the surface with the narrower filter's result at those places; the positions are given up
 * \param[in] fine 1 where the coarse scale lost detail, for every point
 * \return places, ascending
 * \throws InvalidParameter
 */
PCL_GPF_CORE_EXPORT std::vector<std::uint32_t>
confirmThinParts(const ThinPartsParameters& parameters, const PointIndex& points, const ThinParts& found, SoaBuffer positions,
                 const SoaBuffer& normals, const std::vector<std::uint8_t>& fine);

} // namespace pcl_gpf
