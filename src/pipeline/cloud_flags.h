// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Outliers, local noise and edge points of a filtered cloud whose moves are not bounded yet.
 *
 * \param[in] scale as measured, normalised frame; nothing is found out where its spacing is 0
 * \param[in] data_radius h / 2 of the filter, normalised frame
 */
void
findFlags(const DenoiseParameters& parameters, const CloudScale& scale, double data_radius, const Packed& packed,
          const std::vector<std::uint32_t>& samples, FilteredCloud& cloud);

} // namespace pcl_gpf
