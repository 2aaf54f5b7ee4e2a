// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Decimal digits only. */
std::optional<std::uint64_t>
parseCount(const std::string& text);

/** \brief "25000" or "50%", more than 0, at most 100%. */
std::optional<Share>
parseShare(const std::string& text);

/** \brief Three finite numbers with commas between. */
std::optional<std::vector<double>>
parseVector(const std::string& text);

/** \brief Checks a value against its option. \throws UsageError naming option, value and range */
void
checkValue(const OptionSpec& spec, const std::string& value);

} // namespace pcl_gpf
