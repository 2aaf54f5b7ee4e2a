// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <pcl_gpf/pipeline/presets.h>

#include <string>

namespace pcl_gpf {

/** \brief The option --preset of the commands filter and run. */
OptionSpec
presetOption();

/** \brief The parameters of a preset, given by the value of that option. */
DenoiseParameters
presetNamed(const std::string& name);

} // namespace pcl_gpf
