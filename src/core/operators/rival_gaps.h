// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gap_search.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Of the gaps with the numbers `rivals` those that have no better one, of greater priority or equal priority and lower number, whose
 * base is nearer than their own clearance; so that all of them can be filled at once. In spatial order. */
std::vector<std::uint32_t>
bestWithinClearance(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals, std::size_t threads);

} // namespace pcl_gpf
