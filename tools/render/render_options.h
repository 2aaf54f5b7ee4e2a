// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../options.h"

#include <vector>

namespace pcl_gpf {

/** \brief The options of the command render. */
std::vector<OptionSpec>
renderOptions();

} // namespace pcl_gpf
