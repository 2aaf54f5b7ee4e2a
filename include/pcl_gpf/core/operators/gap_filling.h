// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief How points that piled up on sharp edges spread over the empty bands beside them; lengths in the unit of the points. */
struct GapFillingParameters {
  double radius = 0.0;  ///< length of the strips over which points spread, > 0; the band must be narrower, faces may be
  double spacing = 0.0; ///< of the points, > 0; where points are dense only every 2nd, 4th, ... is looked at

  /** Least angle between the normals of two faces in degrees, 0 < angle < 90. */
  double angle = 30.0;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Moves, each within the tangent plane of its point, that take points piled up on a sharp edge into the empty band beside it.
 *
 * A strip of the own face is laid across the edge, beside each small group of points. A point that has a tenth of the strip's points
 * between itself and the edge belongs a tenth of the strip's length away from it: where points lie evenly it is there already, on the
 * edge it is not. Points move away from the edge only, so that none crosses it, and only by more than half a spacing; three quarters of
 * a spacing's worth of them stay on the edge. Points without another face near them, and all of open borders, stay. Signs of normals
 * do not matter.
 *
 * \param[in] positions filtered points, any order \param[in] normals filtered, unit length, one per point
 * \return a move for every point, 0 for most \throws InvalidParameter
 * Cost: O(N), about that of the whole filter; bounded where points are dense.
 * \note Repulsion does not do this: the points on an edge hold each other there, and those behind the band push outwards.
 */
PCL_GPF_CORE_EXPORT SoaBuffer
movesIntoGaps(const GapFillingParameters& parameters, PointsView positions, NormalsView normals);

} // namespace pcl_gpf
