// SPDX-License-Identifier: BSD-3-Clause
#include "gap_stage.h"

#include <cmath>
#include <cstddef>

namespace pcl_gpf {

std::vector<float>
lengthsOf(const SoaBuffer& vectors)
{
  std::vector<float> lengths(vectors.size());
  for (std::size_t k = 0; k < lengths.size(); ++k)
    lengths[k] = std::sqrt(vectors.x[k] * vectors.x[k] + vectors.y[k] * vectors.y[k] + vectors.z[k] * vectors.z[k]);
  return lengths;
}

void
fillGaps(const GPFParameters& parameters, const LocalFrame& frame, const ProgressCallback& progress, GPFState& state, FilteredCloud& cloud)
{
  if (parameters.gap_iterations == 0)
    return;
  SoaBuffer displacements(state.size());
  state.displacements(displacements.view());
  cloud.moves = lengthsOf(displacements);
  cloud.gap_iterations = gpfFillGaps(state, progress);
  for (IterationStats& stats : cloud.gap_iterations) {
    stats.mean_movement = frame.lengthToWorld(stats.mean_movement);
    stats.max_movement = frame.lengthToWorld(stats.max_movement);
  }
}

} // namespace pcl_gpf
