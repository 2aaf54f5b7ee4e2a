// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../kernels/gaps.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Those gaps that are filled when they are taken one after another by priority, and a gap is left out when the base of one that was
 * taken lies within its clearance; equal priorities in the order given.
 *
 * The outcome of that rule is one, so it is found for all gaps at once.
 * \param[in] rivals places in `gaps`, ascending, in which neighbours follow each other
 * \return the places of those to fill, ascending */
std::vector<std::uint32_t>
fillableTogether(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals, std::size_t threads);

} // namespace pcl_gpf
