// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief For every position the nearest source point on the same side of the surface: of the 8 nearest the first whose normal makes an
 * angle of less than 60 degrees with the position's, so that colours are not taken across an edge or from the back of a plate; the
 * nearest of all when there is none.
 *
 * \return indices into the sources; empty when there are no sources. Cost: one query of 8 neighbours a position */
PCL_GPF_CORE_EXPORT std::vector<std::uint32_t>
nearestOnSameSide(PointsView sources,
                  NormalsView source_normals,
                  PointsView positions,
                  NormalsView normals,
                  unsigned number_of_threads = 0);

} // namespace pcl_gpf
