// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "packed_cloud.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_gpf {

/** Filters the packed points at places, ascending, with lengths in the normalised frame. */
using FilterPlaces = std::function<FilteredCloud(const DenoiseParameters& parameters, const std::vector<std::uint32_t>& places)>;

/** Takes a third, finest result where it keeps thin parts that the other two drew together (findThinParts()), if noise is so weak beside
 * the spacing that so narrow a filter is of use.
 * \param[in] parameters lengths in the normalised frame
 * \param[in] measured the cloud's own scale \param[in] scale the same, noise times the strength
 * \param[in] filter called where there are such places */
void
keepThinParts(const DenoiseParameters& parameters, const CloudScale& measured, const CloudScale& scale, const Packed& packed,
              const FilterPlaces& filter, FilteredCloud& cloud, DenoiseResult& result);

} // namespace pcl_gpf
