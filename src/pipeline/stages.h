// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <pcl_gpf/core/analysis/parameter_estimation.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf {

/** The callback as an operator calls it, for the stage of this name. */
ProgressCallback
stageOf(std::string name, const StageProgress& progress);

/** Everything that does not depend on lengths: packs, measures. \param[in,out] parameters lengths come out in the normalised frame
 * \throws InvalidParameter */
Packed
prepare(const DenoiseInput& input, DenoiseParameters& parameters, bool with_remainders, CloudScale& scale, DenoiseResult& result);

/** The normals that the input has, the others from plane fits, all of them filtered. */
void
makeNormals(const DenoiseInput& input, const DenoiseParameters& parameters, FilterScale filter_scale, Packed& packed,
            const StageProgress& progress, DenoiseResult& result);

/** GPF on the packed points and normals, which are given up. */
FilteredCloud
project(const GPFParameters& parameters, FilterScale filter_scale, const std::vector<std::uint32_t>& samples, Packed& packed,
        const StageProgress& progress, std::vector<IterationStats>& iterations);

} // namespace pcl_gpf
