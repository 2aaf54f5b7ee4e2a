// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Mean misfit of the fits in the ball about each.
 *
 * One fit tells its misfit with a scatter of a fifth; those nearby see the same surface with other noise.
 * \param[in] places sorted, followed by a padded element that is far away
 * \param[in] most a larger misfit is that of an edge, which is in the way of its own fit only: left out of the means of others
 * \return the misfit itself where it is larger than `most`
 */
std::vector<double>
poolMisfits(const SortedVectors<float>& places, const std::vector<double>& misfits, double most, double radius, std::size_t threads);

} // namespace pcl_gpf
