// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Lengths and weights of steered plane fits. */
struct SteeredFitParameters {
  double radius = 0.0;           ///< sets the width of a neighbourhood across an edge, >= 0; 0 = estimated, where something estimates it
  double direction_radius = 0.0; ///< of the balls in which normals tell how the surface bends, >= 0; 0 = estimated likewise
  double longest_share = 4.0;    ///< half length of a neighbourhood where nothing bends, as a multiple of `radius`, >= 1
  double bending_weight = 9.0;   ///< how fast neighbourhoods shrink across a bend, >= 0; 0 = balls
  unsigned passes = 4;           ///< each from the result of the one before; 0 = no fit
  unsigned merge_above = 200;    ///< means stand for the points of denser neighbourhoods, which all passes but the last move; 0 = never

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const SteeredFitParameters& parameters);

/** \brief Refines a filtered cloud: planes fitted over neighbourhoods that reach far along an edge and not across it.
 *
 * The filtered cloud is the guide. About each point the mean T of n n^T over the guide's normals tells in which directions the surface
 * bends: T is n n^T on a plane, and has no part along a straight edge. The neighbourhood of the point is the ellipsoid
 * d^T (I / (longest_share radius)^2 + bending_weight T / radius^2) d < 1 of the guide: thin along normals, long where nothing bends. A plane
 * is fitted to the guide in it, weights (1 - d^T A d)^2, and the point moves along that plane's normal to the mean height of the *noisy*
 * points, whose noise is therefore averaged once, over many points, without the clipping that a ball about a noisy point has. Heights are
 * taken half along the point's normal, half as the neighbours' planes say, so that curved surfaces stay where they are.
 * All passes but the last move the data, which are means where neighbourhoods hold many points, and with each mean its points.
 * (Kernels steered by a structure tensor: Takeda, Farsiu, Milanfar 2007; normal tensors: Medioni et al.)
 *
 * \param[in] noisy N positions that the guide was filtered from
 * \param[in] places rows to refine, without repeats; the others only guide
 * \param[in,out] positions, normals the guide; the rows of `places` are replaced. A normal keeps its side
 * \param[in] progress called before each pass and at the end; return false to cancel
 * \throws InvalidParameter (also a radius of 0, unless `passes` is 0, and places beyond the points), ExcessiveWork, Cancelled; passes that
 * were done by then stay
 * Cost: four passes take about a quarter of the time of the whole chain where every point is refined (100,000 points, noise of 4 spacings).
 * Thread safety: free function without shared state.
 */
PCL_GPF_CORE_EXPORT void
fitSteeredPlanes(const SteeredFitParameters& parameters, PointsView noisy, const std::vector<std::uint32_t>& places,
                 MutableVectorsView positions, MutableVectorsView normals, const ProgressCallback& progress = {});

} // namespace pcl_gpf
