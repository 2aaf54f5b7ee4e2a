// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief What counts as a point of a sharp edge; lengths in the unit of the points. */
struct EdgePointsParameters {
  double support_radius = 0.0; ///< h, > 0: neighbours come from the ball h / 2, edge points lie within h / 4 of an edge
  double spacing = 0.0;        ///< of the points, > 0; where points are dense only every 2nd, 3rd, ... is a neighbour

  /** Least angle between the normals of two faces in degrees, 0 < angle < 90. Smaller: weak edges count, and narrow curves too. */
  double angle = 30.0;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Marks the points of a filtered cloud that lie within h / 4 of a sharp edge.
 *
 * The normals in the ball h / 2 fall into faces: those within `angle` of the point's own, then, greedily, the largest set within
 * `angle` of one of (a few of) the others. Two faces meet in the line of their planes; a point is an edge point when that line is within h / 4.
 * Signs of normals do not matter. A face with less than a twentieth of the neighbours, or less than 3, is none.
 *
 * \param[in] positions filtered points, any order \param[in] normals filtered, unit length, one per point
 * \return 1 at edge points, else 0 \throws InvalidParameter
 * Cost: up to half of the chain that made the cloud (more edges cost more).
 * \note A surface that turns by more than `angle` within h / 2 is an edge at this scale.
 */
PCL_GPF_CORE_EXPORT std::vector<std::uint8_t>
edgePoints(const EdgePointsParameters& parameters, PointsView positions, NormalsView normals);

} // namespace pcl_gpf
