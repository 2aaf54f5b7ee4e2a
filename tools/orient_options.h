// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"
#include "options.h"

#include <pcl_gpf/core/operators/normal_orientation.h>

#include <array>
#include <optional>
#include <vector>

namespace pcl_gpf {

using Viewpoint = std::optional<std::array<double, 3>>;

/** \brief The options that set NormalOrientationParameters and the viewpoint. */
std::vector<OptionSpec>
orientOptions();

/** \brief What --viewpoint stands for; a file without a sensor has its viewpoint at the origin, which auto takes for none.
 * \throws UsageError */
Viewpoint
chosenViewpoint(const Options& options, const CloudFile& file);

/** \brief The parameters chosen; measures the cloud when a length is given in spacings or diagonals. */
NormalOrientationParameters
readOrientationParameters(const Options& options, const LoadedCloud& cloud);

} // namespace pcl_gpf
