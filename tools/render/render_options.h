// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../options.h"

#include <pcl_gpf/core/analysis/position.h>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief The options of the command render. */
std::vector<OptionSpec>
renderOptions();

/** \brief Refuses what does not go together. \throws UsageError */
void
checkRenderOptions(const Options& options);

/** \brief Whether a slice is to be shown. */
bool
isSection(const Options& options);

/** \brief Value of an option with three numbers. */
Position
vectorOption(const Options& options, const std::string& name);

} // namespace pcl_gpf
