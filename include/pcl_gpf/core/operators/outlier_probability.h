// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <vector>

namespace pcl_gpf {

/** \brief What the outliers of a filtered cloud are judged by; lengths in the normalised frame. */
struct OutlierProbabilityParameters {
  double noise = 0.0;           ///< standard deviation along the normal, >= 0
  double spacing = 0.0;         ///< of the points, > 0
  double data_radius = 0.0;     ///< h / 2 of the filter, > 0: the ball over which the uniform component spreads its mass
  double outlier_weight = 0.02; ///< omega of eq. 1, 0 <= omega < 1; 0: nothing is an outlier

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Posterior of the uniform component (eq. 1) for every filtered point, given how far it moved and what supports its place.
 *
 * Two components may have made a point that was found at height r above its filtered place:
 * the surface, with a density of lambda N(r; s) (points per volume), and outliers, with omega times the data that the spacing lets
 * expect in the data ball, evenly over the volume of that ball (no smaller than the one in which support is counted). s is the noise
 * with a quarter added, because surface and noise are estimates, and at least half of the spacing. lambda, the density of the
 * surface per area, is counted where the point was put: input points (not its own) in a ball as wide as the noise, less what
 * outliers alone would put there and twice the standard deviation of that.
 * So a point is an outlier when it came from too far away, or when hardly any other point is where it went.
 *
 * \param[in] data the unfiltered points \param[in] filtered their filtered places, before moves are bounded, in any order; that of
 * data.sorted() saves the time and memory of sorting them \param[in] moves length of each move, as many as there are places
 * \return 0 .. 1 for each filtered point
 * \throws InvalidParameter
 * Cost: a small part of one filter iteration.
 * \note Outliers that lie as densely as a surface are one to this test, and a part sampled about ten times more sparsely than the
 * rest may be taken for outliers.
 */
PCL_GPF_CORE_EXPORT std::vector<float>
outlierProbabilities(const OutlierProbabilityParameters& parameters, const PointIndex& data, const SoaBuffer& filtered, const float* moves);

} // namespace pcl_gpf
