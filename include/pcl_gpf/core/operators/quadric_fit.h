// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Lengths and tests of quadric fits. */
struct QuadricFitParameters {
  double radius = 0.0;       ///< of the narrowest ball, >= 0; 0 = estimated, where something estimates it
  double noise = 0.0;        ///< standard deviation along the normal at the quietest places, >= 0, the unit of the radius
  double spacing = 0.0;      ///< of the points, > 0, the unit of the radius
  unsigned levels = 7;       ///< balls of radius 1, 2^0.35, 2^0.7, ... times `radius`; 0 = no fit
  double misfit = 1.2;       ///< variance of mean heights about the quadric, in those that noise explains, up to which it is believed, > 0
  double pooling = 1.0;      ///< misfits are means over the fits in a ball of so many radii, >= 0; 0 = each fit by itself
  unsigned merge_above = 192; ///< a ball that holds more points is represented by between half as many and as many means, >= 16

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const QuadricFitParameters& parameters);

/** \brief Moves the points of smooth parts of a filtered cloud onto quadrics fitted to the noisy heights of wide balls.
 *
 * On a smooth surface a quadric averages over a wider ball than planes can: its error grows with the fourth power of the radius. Data of a
 * fit are means of a few points each. Where the quadric is the surface, means differ from it by as much as the points of each mean
 * differ among themselves (the test of lack of fit, its statistic averaged over the fits nearby), and the filtered normals change evenly
 * along it. Radii grow while both hold; at the first that fails, or next to an edge at once, points stay where the narrower ball, or the
 * filter, left them. Both tests pass by degrees, so that no seam arises.
 *
 * Two biases are taken out: that of the fourth order, known from the quadric where curvatures are constant (spheres, cylinders), and
 * that of noise which also moves points sideways on a curved surface, noise^2 times the mean curvature (even noise in all directions).
 *
 * \param[in] noisy N positions that the cloud was filtered from
 * \param[in,out] positions, normals the filtered cloud; a normal keeps its side
 * \param[in] progress called before each level and at the end; return false to cancel
 * \throws InvalidParameter (also a radius of 0, unless `levels` is 0), ExcessiveWork, Cancelled
 * Cost: that of a few rounds of the bilateral normal filter at most; one fit serves some consecutive points. The widest ball has 0.17
 * of the normalised frame; left out are those that hold fewer points than there are means to fit to. Thread safety: free function
 * without shared state.
 */
PCL_GPF_CORE_EXPORT void
fitQuadrics(const QuadricFitParameters& parameters, PointsView noisy, MutableVectorsView positions, MutableVectorsView normals,
            const ProgressCallback& progress = {});

} // namespace pcl_gpf
