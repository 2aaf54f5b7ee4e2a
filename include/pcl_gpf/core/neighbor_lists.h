// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_gpf {

/** \brief Neighbours of many queries in compressed rows: row q is indices[offsets[q]] .. indices[offsets[q + 1]], ascending. */
struct NeighborLists {
  std::vector<std::size_t> offsets; ///< queries + 1 entries
  std::vector<std::uint32_t> indices;
};

/** \brief A neighbour search that replaces the built-in one: for every query all data points within `radius` (normalised frame).
 *
 * Pairs slightly beyond the radius are welcome: operators test the distance again. The order within a row is free.
 * Called from one thread. `data` may differ from call to call (the projected points move).
 */
using NeighborSearch = std::function<NeighborLists(PointsView data, PointsView queries, double radius)>;

} // namespace pcl_gpf
