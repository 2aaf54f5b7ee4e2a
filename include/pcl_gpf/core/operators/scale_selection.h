// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief What decides between two filtered clouds, one of a wide and one of a narrow data ball; lengths in the normalised frame. */
struct ScaleSelectionParameters {
  double noise = 0.0;         ///< standard deviation along the normal, >= 0
  double spacing = 0.0;       ///< of the points, > 0
  double fine_radius = 0.0;   ///< h / 2 of the fine filter, > 0
  double coarse_radius = 0.0; ///< h / 2 of the coarse filter, > fine_radius

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Tells for every point whether the coarse filter took detail away that the fine one keeps.
 *
 * Where the coarse surface is right, the input's heights above it are noise alone, and the mean over a small patch is close to 0; where
 * it cut a boss off, the mean is the boss. The squared mean less what noise leaves in it estimates the squared bias of the coarse
 * surface; the variance of each surface is added, 1.2 times, and the smaller sum wins (between mean squared error and Mallows' C_p,
 * over a neighbourhood). Noise is that of the patch, or of the neighbourhood, where it is stronger than `noise`: no detail because of that.
 * Two sheets drawn together show as heights that spread more than noise and of which few are small.
 * Heights count up to four deviations of those nearby, so that outliers do not decide.
 * Patches that reach across an edge of the coarse surface do not count: heights of points beside an edge are not even noise.
 *
 * \param[in] points the noisy input
 * \param[in] coarse_positions, coarse_normals the coarse result in the order of points.sorted(); the positions are given up
 * \return 1 where the fine result is to be taken, for each sorted point
 * \throws InvalidParameter
 * Cost: less than one round of the bilateral normal filter; where points are dense only every 2nd, 4th, ... is looked at.
 */
PCL_GPF_CORE_EXPORT std::vector<std::uint8_t>
selectFineScale(const ScaleSelectionParameters& parameters, const PointIndex& points, SoaBuffer coarse_positions,
                const SoaBuffer& coarse_normals);

} // namespace pcl_gpf
