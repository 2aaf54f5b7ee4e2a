// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/common/unpack.h>

#include <cstdint>
#include <string>
#include <vector>

/** \file
 * \brief The parts of OperatorFilter that need no point type.
 */
namespace pcl_gpf::detail {

/** \brief The seeds at `kept` positions of PackedCloud::chosen, not moved yet, with their normals. */
PCL_GPF_EXPORT FilteredPoints
seedPoints(const PackedCloud& packed, std::vector<std::uint32_t> kept);

/** \brief Cloud index of the seed of every output point. */
PCL_GPF_EXPORT pcl::Indices
seedIndices(const PackedCloud& packed, const std::vector<std::uint32_t>& kept);

/** \brief Chosen cloud indices that seeded no point or are not finite, ascending. */
PCL_GPF_EXPORT pcl::Indices
removedIndices(const PackedCloud& packed, const std::vector<std::uint32_t>& kept);

/** \brief Says on PCL's console which points are not filtered and why. */
PCL_GPF_EXPORT void
warnAboutPoints(const std::string& filter, const PackedCloud& packed, bool degenerate);

} // namespace pcl_gpf::detail
