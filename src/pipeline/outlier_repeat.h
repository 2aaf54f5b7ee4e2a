// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/pipeline/denoise.h>

#include <functional>

namespace pcl_gpf {

/** Whether so many points are outliers that they do harm as data of the others. Never for the paper's recursion and for samples. */
bool
outliersDisturb(const DenoiseParameters& parameters, const DenoiseInput& input, const DenoiseResult& result);

/** Filters the points that are hardly outliers once more, by themselves; the others keep what the first run made of them.
 * \param[in] filter runs the chain on part of the input \return every point in order, lengths and iterations of the second run */
DenoiseResult
repeatWithoutOutliers(const DenoiseInput& input, DenoiseResult first, const std::function<DenoiseResult(const DenoiseInput&)>& filter);

} // namespace pcl_gpf
