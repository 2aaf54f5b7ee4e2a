// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Every different position once. */
SoaBuffer
distinctPoints(PointsView points);

/** \brief The first of the points at each position, ascending. Cost: two sorts. */
std::vector<std::uint32_t>
differentPoints(PointsView points);

/** \brief Whether more than 2 % of the points of an index lie where the one before them lies, as half of all copies do at least: they
 * share a place on the curve. Cost: one pass. */
bool
repeatsManyPoints(PointsView sorted);

} // namespace pcl_gpf
