// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <cstddef>
#include <string>

namespace pcl_gpf {

/** Fewest points whose noise can be told (estimateNoise()). */
constexpr std::size_t kFewestForNoise = 48;

/** Fills the lengths that are to be estimated (estimateParameters()) and notes in `result` where they came from.
 * \param[in] parameters lengths in the normalised frame
 * \param[in] scale normalised frame, noise times the strength
 */
DenoiseParameters
parametersAt(FilterScale filter_scale, DenoiseParameters parameters, const CloudScale& scale, const LocalFrame& frame,
             DenoiseResult& result);

/** What a reason says about a strength other than 1. */
std::string
strengthNote(double strength);

} // namespace pcl_gpf
