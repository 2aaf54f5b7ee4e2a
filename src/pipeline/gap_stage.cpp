// SPDX-License-Identifier: BSD-3-Clause
#include "gap_stage.h"

namespace pcl_gpf {

void
fillGaps(const GPFParameters& parameters, const LocalFrame& frame, const ProgressCallback& progress, GPFState& state, FilteredCloud& cloud)
{
  if (parameters.gap_iterations == 0)
    return;
  cloud.before_gaps = SoaBuffer(state.size());
  state.displacements(cloud.before_gaps.view());
  cloud.gap_iterations = gpfFillGaps(state, progress);
  for (IterationStats& stats : cloud.gap_iterations) {
    stats.mean_movement = frame.lengthToWorld(stats.mean_movement);
    stats.max_movement = frame.lengthToWorld(stats.max_movement);
  }
}

} // namespace pcl_gpf
