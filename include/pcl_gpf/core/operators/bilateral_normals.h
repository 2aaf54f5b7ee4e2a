// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Parameters of the bilateral normal filter (Huang et al., "Edge-Aware Point Set Resampling", ACM TOG 2013, section 4). */
struct BilateralNormalsParameters {
  /** Support radius sigma_p, in the unit of the points, >= 0; 0 = from `neighbors`, or estimated when that is 0 too.
   * Too small: noise stays in the normals. Too large: narrow faces take their neighbours' normals. */
  double radius = 0.0;

  /** Number of neighbours k, 0 or 3 .. 1000, whose farthest sets the radius of each point instead; not together with `radius`. */
  unsigned neighbors = 0;

  /** Angle sigma_n in degrees, 0 < sigma_n <= 90, at which a neighbour's weight has fallen to 1/e. Below the angular noise of
   * the input nothing is averaged; above the smallest edge angle edges round off. */
  double angle = 30.0;

  /** Rounds, 0 .. 1000; 0 only normalises. 3 to 5 are enough, more sharpen further. */
  unsigned iterations = 5;

  /** Flip neighbours of opposite sign before averaging, so that no orientation is needed. False: the formula of EAR, which needs
   * consistently oriented normals. */
  bool sign_invariant = true;

  /** Where a ball holds more points than this, means of neighbouring points that face the same way stand for them, at least half as
   * many as this: all rounds but the last filter the means, the last gives every point its own normal. 0 = never; no effect on
   * oriented normals. Bounds the time of dense clouds; sparse parts, whose balls hold fewer, are not changed. */
  unsigned merge_above = 200;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const BilateralNormalsParameters& parameters);

/** \brief What the normal filter did. */
struct BilateralNormalsStatistics {
  std::vector<double> mean_change; ///< mean turn of a normal in each round, degrees
  std::size_t isolated_points = 0; ///< points without a neighbour; they keep their normal
  double seconds = 0;
};

/** \brief Filters normals in place: n_i <- normalise(sum_j theta(|p_i - p_j|) psi(n_i, n_j) n_j), the point itself included,
 * theta(r) = exp(-r^2 / radius^2), psi = exp(-((1 - n_i.n_j) / (1 - cos angle))^2); all from all of the round before (Jacobi).
 *
 * \param[in] parameters `radius` in the unit of `points`; radius and neighbors not both 0
 * \param[in] points N finite positions, normalised frame
 * \param[in,out] normals N vectors of any length > 0; unit vectors afterwards
 * \param[in] search replaces the built-in neighbour search when set and `neighbors` is 0
 * \throws InvalidParameter, ExcessiveWork, Cancelled
 */
PCL_GPF_CORE_EXPORT BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters,
                         PointsView points,
                         MutableVectorsView normals,
                         const NeighborSearch& search = {},
                         const ProgressCallback& progress = {});

/** \brief The same on points that are sorted already; normals in sorted order. */
PCL_GPF_CORE_EXPORT BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters,
                         const PointIndex& points,
                         MutableVectorsView normals,
                         const NeighborSearch& search = {},
                         const ProgressCallback& progress = {});

} // namespace pcl_gpf
