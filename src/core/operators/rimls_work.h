// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/point_index.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief Refuses a support radius that holds so many points that the mesh takes minutes; a few milliseconds.
 *
 * \param[in] rimls as the surface will use it, lengths in the frame of the points \param[in] spacing of the points
 * \param[in] cells that the surface passes through, estimated
 * \throws ExcessiveWork with points in the ball, pairs and seconds */
void
refuseExcessiveMeshWork(const RimlsParameters& rimls, const PointIndex& points, double spacing, double cells);

/** \brief The same for a projection. \param[in] positions how many are projected \throws ExcessiveWork */
void
refuseExcessiveProjection(const RimlsParameters& rimls, const PointIndex& points, double spacing, std::size_t positions);

} // namespace pcl_gpf
