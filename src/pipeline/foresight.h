// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <cstddef>

namespace pcl_gpf {

/** Estimates every stage of the chain before the first begins.
 * \param[in] p all lengths set, normalised frame \param[in] samples points that GPF moves; 0 = GPF does not run
 * \throws ExcessiveWork naming the parameter, pairs, seconds and memory */
void
refuseExcessiveStages(const DenoiseParameters& p, const Packed& packed, std::size_t samples);

} // namespace pcl_gpf
