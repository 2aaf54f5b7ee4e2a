// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Consistently oriented normals of a cloud in double coordinates. */
struct OrientResult {
  std::vector<float> normal_x, normal_y, normal_z; ///< of each row, unit length; NaN where the position is not finite
  NormalOrientationStatistics orientation;         ///< noise in cloud units
  std::size_t non_finite_points = 0;
  std::size_t estimated_normals = 0; ///< that the input did not have
  double seconds_normals = 0;        ///< of estimating them
};

/** \brief Orients the normals of a cloud; only signs of normals that the input has change (and lengths, to 1).
 *
 * Without any normal they are estimated first (plane fits, then the bilateral filter); a missing one here and there
 * gets its plane fit.
 * \param[in] parameters `noise` in cloud units \param[in] viewpoint in cloud units, or null
 * \throws InvalidParameter, UnsuitableData (nothing finite, all points identical), ExcessiveWork, Cancelled
 * Thread safety: free function without shared state.
 */
PCL_GPF_EXPORT OrientResult
orientCloud(const DenoiseInput& input,
            const NormalOrientationParameters& parameters,
            const std::array<double, 3>* viewpoint = nullptr,
            const StageProgress& progress = {});

} // namespace pcl_gpf
