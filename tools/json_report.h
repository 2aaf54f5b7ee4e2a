// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pcl_gpf {

class Options;

/** \brief An object that begins with "schema" (pcl_gpf.COMMAND/1, the number grows when keys change meaning) and "version". */
nlohmann::ordered_json
newReport(const std::string& command);

/** \brief Writes the report where --json says: standard output, or a file (atomically). Does nothing without --json.
 * \throws IoError (kind Unwritable) */
void
writeReport(const nlohmann::ordered_json& report, const Options& options);

/** \brief Most memory that this process had at any time, bytes. */
std::size_t
peakMemory();

} // namespace pcl_gpf
