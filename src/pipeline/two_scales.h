// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <pcl_gpf/core/operators/quadric_fit.h>
#include <pcl_gpf/core/operators/scale_selection.h>
#include <pcl_gpf/core/operators/steered_fit.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Whether the chain runs at two scales: wanted, all lengths estimated, every point kept, moves along normals only. */
bool
filtersTwoScales(const DenoiseParameters& parameters);

/** The sorted points at which the coarse result is to be replaced, ascending. */
std::vector<std::uint32_t>
lostDetail(const ScaleSelectionParameters& selection, const Packed& packed, const FilteredCloud& coarse);

/** Fits steered planes to the filtered cloud at `places` (fitSteeredPlanes()). \param[in] parameters normalised frame */
void
steer(const SteeredFitParameters& parameters, const Packed& packed, const std::vector<std::uint32_t>& places, FilteredCloud& cloud,
      const ProgressCallback& progress);

/** Moves smooth parts of the filtered cloud onto quadrics (fitQuadrics()). \param[in] parameters normalised frame */
void
fitSmoothParts(const QuadricFitParameters& parameters, const Packed& packed, FilteredCloud& cloud, const ProgressCallback& progress);

/** Puts the results at `places` into the whole. */
void
replaceAt(const std::vector<std::uint32_t>& places, const FilteredCloud& fine, FilteredCloud& whole);

} // namespace pcl_gpf
