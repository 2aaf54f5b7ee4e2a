// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstddef>

namespace pcl_gpf {

/** \brief Parameters of consistent orientation. */
struct NormalOrientationParameters {
  /** Neighbours k that each point votes with, 3 .. 100. Too few: strong noise breaks the surface into pieces or leaves
   * single signs wrong. Too many: sheets nearer than the k-th neighbour vote against each other. */
  unsigned neighbors = 16;

  /** Standard deviation of the positions along the normal, in the unit of the points, >= 0; 0 = estimated,
   * curvature included. Offsets between neighbours that are not longer than this tell nothing of the surface. Too
   * small: signs of noisy points turn at random. Too large: the two sides of thin plates are taken for one. */
  double noise = 0.0;

  /** Gap, in local spacings, 0 .. 100, across which separate pieces of surface still vote with each other. 0: each
   * piece for itself. */
  double gap = 6.0;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const NormalOrientationParameters& parameters);

/** \brief What the orientation did. */
struct NormalOrientationStatistics {
  std::size_t parts = 0;             ///< connected pieces after gaps are bridged; each got its side on its own
  std::size_t parts_by_viewpoint = 0;
  std::size_t parts_outward = 0;     ///< closed parts
  std::size_t parts_by_root = 0;     ///< open parts without a viewpoint that tells: the highest point looks up
  std::size_t flipped = 0;           ///< normals whose sign changed
  std::size_t votes = 0;             ///< pairs of neighbours, each direction for itself
  std::size_t disagreeing_votes = 0; ///< those that the result goes against, mostly at places too thin for the data
  double noise = 0;                  ///< that was used, in the unit of the points
  double seconds = 0;
};

/** \brief Gives normals consistent signs: only signs change, never directions.
 *
 * Neighbours vote for their relative sign: n_i.n_j - 2 (n_i.d)(n_j.d) / |d|^2 c, d = p_j - p_i. That is Hoppe's n_i.n_j
 * with n_i mirrored in the plane between the points (Xie), so that creases of more than 90 degrees and facing sheets
 * count rightly; c = 1 / (1 + (l / |d|)^4) leaves the mirror out for offsets that tell nothing, l^2 = 8 noise^2 +
 * 2 spacing^2 cos^2(2 angle). A maximum spanning tree is then grown as Boruvka does, but votes between pieces that have
 * grown together are added up, so that no single bad pair decides for a whole face; in the end every point follows the
 * majority of its neighbours. The side of each part:
 * 1. toward `viewpoint`, if given and the part clearly faces it or turns its back;
 * 2. else outward, if the part is closed (its vector area is less than a quarter of its area);
 * 3. else toward `viewpoint` if given; else its highest point (greatest z) gets n_z > 0.
 *
 * \param[in] points N finite positions \param[in,out] normals N unit vectors in sorted order, any signs
 * \param[in] viewpoint in the frame of the points, or null
 * Cost: O(N) after N queries of k neighbours; memory about 15 k bytes a point.
 * \throws InvalidParameter, Cancelled
 */
PCL_GPF_CORE_EXPORT NormalOrientationStatistics
orientNormals(const NormalOrientationParameters& parameters,
              const PointIndex& points,
              MutableVectorsView normals,
              const std::array<double, 3>* viewpoint = nullptr,
              const ProgressCallback& progress = {});

/** \brief The same on points in any order; normals in the same order. */
PCL_GPF_CORE_EXPORT NormalOrientationStatistics
orientNormals(const NormalOrientationParameters& parameters,
              PointsView points,
              MutableVectorsView normals,
              const std::array<double, 3>* viewpoint = nullptr,
              const ProgressCallback& progress = {});

} // namespace pcl_gpf
