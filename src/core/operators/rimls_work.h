// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/point_index.h>

namespace pcl_gpf {

/** \brief Refuses a support radius that holds so many points that the mesh takes minutes; a few milliseconds.
 *
 * \param[in] rimls as the surface will use it, lengths in the frame of the points \param[in] spacing of the points
 * \param[in] cells that the surface passes through, estimated
 * \throws ExcessiveWork with points in the ball, pairs and seconds */
void
refuseExcessiveMeshWork(const RimlsParameters& rimls, const PointIndex& points, double spacing, double cells);

} // namespace pcl_gpf
