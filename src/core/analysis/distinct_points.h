// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief Every different position once. Cost: one sort. */
SoaBuffer
distinctPoints(PointsView points);

/** \brief How many points of an index lie where the one before them lies: almost all that repeat a position, since they share a place
 * on the curve. Cost: one pass. */
std::size_t
countRepeated(PointsView sorted);

} // namespace pcl_gpf
