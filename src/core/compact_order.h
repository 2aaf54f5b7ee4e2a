// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Order in which 2, 4, 8 ... 256 consecutive points lie close together, as indices: the Hilbert curve, cut into patches of 256
 * points, each of which is halved again and again across the longest side of its box. Coincident points keep the order of the curve.
 *
 * Boxes of clusters and of blocks of queries are smaller than on the curve alone, which spares the sums over pairs a sixth of
 * their steps. Cost: O(N).
 */
std::vector<std::uint32_t>
compactOrder(PointsView points, std::size_t threads);

} // namespace pcl_gpf
