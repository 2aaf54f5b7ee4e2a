// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/operators/gpf.h>

namespace pcl_gpf {

/** Rounds of gap filling, if any are asked for. Notes in `cloud` what they did, movements in cloud units, and where each point was before
 * it moved sideways. */
void
fillGaps(const GPFParameters& parameters, const LocalFrame& frame, const ProgressCallback& progress, GPFState& state, FilteredCloud& cloud);

} // namespace pcl_gpf
