// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/views.h>

#include <vector>

namespace pcl_gpf {

/** \brief Over what localNoise() averages; lengths in the unit of the points. */
struct LocalNoiseParameters {
  double radius = 0.0;  ///< of the ball about each point, > 0
  double spacing = 0.0; ///< of the points, > 0; where points are dense only every 2nd, 3rd, ... counts

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Root mean square move of the points of the same face about each filtered point: the noise that was taken out there.
 *
 * Points weigh by the agreement of normals and by `weights`; where nothing has weight, the result is 0.
 * \param[in] moves length of each point's move, not its square \param[in] weights for example 1 - outlier probability, or null = 1
 * \throws InvalidParameter
 * Cost: less than one filter iteration.
 */
PCL_GPF_CORE_EXPORT std::vector<float>
localNoise(const LocalNoiseParameters& parameters, PointsView filtered, NormalsView normals, const float* moves, const float* weights);

} // namespace pcl_gpf
