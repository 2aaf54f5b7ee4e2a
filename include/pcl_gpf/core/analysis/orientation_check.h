// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Share of normals, 0 .. 0.5, whose sign is not that of the majority of their connected part, measured against
 * orientNormals(): 0 when all parts are consistent, whichever side they look to, about 0.5 when signs are random.
 *
 * Cost: that of orientNormals() and N queries of 8 neighbours.
 * \param[in] points N finite positions, normalised frame \param[in] normals N unit vectors in sorted order */
PCL_GPF_CORE_EXPORT double
inconsistentOrientation(const PointIndex& points, NormalsView normals, unsigned number_of_threads = 0);

/** \brief Refuses normals of which a tenth or more are inconsistent, with the cure in the message. Fewer than 500 points are not judged.
 *
 * \param[in] normals in the order of the points
 * \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
requireConsistentOrientation(PointsView points, NormalsView normals, unsigned number_of_threads = 0);

} // namespace pcl_gpf
