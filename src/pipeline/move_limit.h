// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

namespace pcl_gpf {

/** Length of the k-th move. */
double
lengthOf(const SoaBuffer& moves, std::size_t k);

/** Limits how far each point moves: `max_move` where it is set, else 6 times the noise; none where the radius is given, in the paper's
 * recursion, and where the noise is uneven. No move at all where the points are too few for a noise to be told (48), or so few that the
 * filter is as wide as the shape (biasOfFewPoints()) and their moves are longer than noise alone makes them. Where gaps were filled,
 * 6 times the noise bounds the move before that. Notes the limit and how many points it cut in `result`.
 * \param[in] noise normalised frame, times the strength
 * \param[in] spacing normalised frame
 */
void
limitMoves(const DenoiseParameters& wanted, double noise, double spacing, const LocalFrame& frame, FilteredCloud& cloud, DenoiseResult& result);

} // namespace pcl_gpf
