// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Parameters of edge-aware upsampling (Huang et al., "Edge-Aware Point Set Resampling", ACM TOG 2013, section 5).
 *
 * Where the work ends is told by one of `target_count`, `factor` and `spacing`.
 */
struct EdgeAwareUpsamplingParameters {
  /** Points in all, those of the input included, N .. 1000 N; 0 = by `factor` or `spacing`. */
  std::size_t target_count = 0;
  /** Points in all as a multiple of the input's, 1 .. 1000; 0 = by the others, and 2 when they are 0 too. */
  double factor = 0.0;
  /** Distance of neighbours to fill up to, in the unit of the points, >= 0; 0 = by the others. Parts that are finer stay. */
  double spacing = 0.0;

  /** Radius R in the unit of the points, >= 0; 0 = 3 times the spacing of the input. Gaps wider than R stay open (holes, distant
   * sheets), and new points are projected with the input points within R. Below 2 spacings gaps stay; large values round details. */
  double radius = 0.0;

  /** Angle sigma_n in degrees, 0 < sigma_n <= 90, at which a neighbour's weight has fallen to 1/e. Below the angular noise of the
   * normals new points carry that noise; above the smallest edge angle edges round off. */
  double angle = 30.0;

  /** Exponent rho of the factor (2 - n.n') in the priority of a gap, 0 .. 10: 0 = the widest gap first, wherever it is; 5 (the
   * paper) = gaps across an edge count 32 times as much, so edges are filled first and more densely. */
  double edge_sensitivity = 5.0;

  /** Align the normals of each pair before they are compared, so that no orientation is needed; sheets of one body closer than 2
   * spacings are then taken for one. False: the formula of EAR, which needs consistently oriented normals. */
  bool sign_invariant = true;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range and that at most one target is set. \throws InvalidParameter */
PCL_GPF_CORE_EXPORT void
validate(const EdgeAwareUpsamplingParameters& parameters);

/** \brief Points in all that the parameters ask for, given the size of the input; the most that are made when they ask for a
 * spacing. \throws InvalidParameter when the target lies below the input or beyond 1000 times as much, ExcessiveWork */
PCL_GPF_CORE_EXPORT std::size_t
targetCount(const EdgeAwareUpsamplingParameters& parameters, std::size_t input);

/** \brief The inserted points; the input is not repeated. */
struct EdgeAwareUpsamplingResult {
  SoaBuffer points;  ///< M new positions in the frame of the input, in order of insertion
  SoaBuffer normals; ///< their unit normals, with the sign of the side that they lie on

  /** Input point from which each new point takes what is not geometry: the one with the largest weight in its projection, so
   * near, and on the same side of the edge. */
  std::vector<std::uint32_t> parents;
  /** The two points between which each was inserted: values below N are input points, N + k is new point k < its own number. */
  std::vector<std::uint32_t> first_base, second_base;

  double radius = 0;        ///< R used, in the unit of the points
  double widest_gap = 0;    ///< of those that the last round left: distance of a base to the nearest point, along the surface
  std::size_t rounds = 0;
  bool target_reached = true; ///< false: no gap was left to fill within R
  double seconds = 0;
};

/** \brief Fills the gaps between points, edges first: EAR's base selection, insertion and bilateral projection.
 *
 * For neighbours v, t within R the base is b = (v + t) / 2, its clearance C(b) the least squared distance of b to the line through
 * a neighbour s along n_s, its priority (2 - n_v.n_t)^rho C(b). A base is moved along a normal onto the weighted planes of the
 * input points around it, with weights exp(-4 r^2 / R^2) exp(-((1 - n.n_q) / (1 - cos angle))^2), n that of v or of t: in a face
 * whichever moves it less, beside an edge the one that brings it nearer to the edge; one about as far from both planes moves onto the
 * edge where they meet. In place of the sequential loop of EAR, each round fills all gaps that filling one after another by priority
 * would fill without searching again; results are the same bits for any number of threads.
 * Cost: O(points in all), about 2 us for each new one; memory about 150 bytes each.
 *
 * \param[in] points N >= 3 finite positions that do not lie on one line, normalised frame
 * \param[in] normals N vectors of any length > 0
 * \throws InvalidParameter (also when the target lies below N), UnsuitableData, ExcessiveWork, Cancelled
 */
PCL_GPF_CORE_EXPORT EdgeAwareUpsamplingResult
upsampleEdgeAware(const EdgeAwareUpsamplingParameters& parameters,
                  PointsView points,
                  NormalsView normals,
                  const ProgressCallback& progress = {});

/** \brief The same for points that have an index already; points and normals are in sorted order, and so are the numbers of the result.
 * \param[in] spacing of the points, as estimateSpacing() gives it */
PCL_GPF_CORE_EXPORT EdgeAwareUpsamplingResult
upsampleEdgeAware(const EdgeAwareUpsamplingParameters& parameters,
                  const PointIndex& points,
                  NormalsView normals,
                  double spacing,
                  const ProgressCallback& progress = {});

} // namespace pcl_gpf
