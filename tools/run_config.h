// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Reads options from a JSON file: {"stages": ["filter", "mesh"], "threads": 2, "mesh": {"resolution": 300}} says what
 * --stages filter,mesh --threads 2 --mesh-resolution 300 says. Flags and on|off are true or false.
 * \param[in] table the options that may stand there
 * \throws IoError (kind Unreadable) when it cannot be read or is no JSON object, UsageError for its options, both naming the file */
Options
readConfig(const std::string& path, const std::vector<OptionSpec>& table);

} // namespace pcl_gpf
