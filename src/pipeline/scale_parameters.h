// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <cstddef>
#include <string>

namespace pcl_gpf {

/** Fewest points whose noise can be told (estimateNoise()). */
constexpr std::size_t kFewestForNoise = 48;

/** By how much the estimated lengths, 6 to 8 spacings at least, move the surface of a cloud of so few points: its radii are then as wide
 * as its features. The fourth power of their ratio, from cubes and spheres of 60 to 2,000 points; cloud units, those of `spacing`. */
double
biasOfFewPoints(double spacing, double points);

/** Lengths of the parameters from cloud units into the normalised frame; the number of threads for every stage. */
DenoiseParameters
toLocal(DenoiseParameters parameters, const LocalFrame& frame);

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
