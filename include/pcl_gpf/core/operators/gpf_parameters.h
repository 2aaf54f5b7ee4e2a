// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

#include <cstdint>

namespace pcl_gpf {

/** \brief How sigma^2 of the mixture changes from iteration to iteration. */
enum class VarianceUpdate {
  Paper,              ///< eq. 11 as printed, d = 3
  OneDegreeOfFreedom, ///< eq. 11 divided by N_p alone: a point-to-plane residual has one degree of freedom, not three
  Fixed               ///< sigma^2 stays at its initial value
};

/** \brief Which planes pull a projected point. */
enum class DataTerm {
  PointToPlane, ///< eq. 5: the plane of each input point; exact on planes, inflates curved parts by h^2 / (16 R)
  Symmetric     ///< the bisector of both points' planes, which vanishes to second order on curved surfaces
};

/** \brief Parameters of GPF (Lu et al., TVCG 2017). The default is a filter that keeps every point; paper() is Algorithm 1.
 *
 * Lengths are in the unit of the points they are used with: cloud units in GPF<PointT> and in the tool, the normalised frame
 * (box diagonal 1) in the core.
 */
struct GPFParameters {
  /** Support radius h (eq. 6): data come from the ball h / 2, repulsion from the ball h. >= 0; 0 = estimated from spacing and noise.
   * Too small: noise stays. Too large: fine detail and close sheets merge; time grows with h^2. */
  double support_radius = 0.0;

  /** Repulsion weight mu-hat (eq. 10), 0 .. 0.5. 0: points move along normals only, so colours and ids stay where they were.
   * 0.05 .. 0.30 is the paper's range for an even resampling; larger values push points across sharp edges. */
  double repulsion_weight = 0.0;

  /** Weight omega of the uniform component (eq. 1), 0 <= omega < 1. Near 1: outliers pull less. Acts on the filter through
   * eq. 3 only; denoise() also takes it as the prior of its outlier probabilities. */
  double outlier_weight = 0.02;

  /** Initial sigma^2 of the mixture in the normalised frame, >= 0; 0 = (h / 2)^2, nearly constant weights inside the data ball.
   * Smaller: finer detail and less smoothing. \note In the paper's frame 0.004 is far wider than the data ball. */
  double initial_variance = 0.0;

  /** How sigma^2 goes on. \note The paper's update measures a residual of one degree of freedom and divides it by three, so that
   * sigma^2 collapses and filtering stops: use it for reproduction, not for filtering. */
  VarianceUpdate variance_update = VarianceUpdate::Fixed;

  /** Which planes pull. */
  DataTerm data_term = DataTerm::Symmetric;

  /** Whether weights are normalised over the projected points that claim an input point (E-step, eq. 3). Off: every pair weighs
   * exp(-r^2 / (2 sigma^2)), omega has no effect, and N_p is the sum of those weights. */
  bool posterior_normalization = false;

  /** Divide data weights by the input density rho_n and multiply repulsion by the sample density w_m (eq. 10). */
  bool density_weights = false;

  /** Angle sigma_d in degrees, 0 < sigma_d <= 90, at which the data weight of an input point with another normal has fallen to 1/e
   * of what `normal_weight_floor` leaves; 90 = normals do not matter (the paper). Small: each face is filtered by itself. */
  double normal_angle = 45.0;

  /** Share of the data weight, 0 .. 1, that does not depend on normals; lets points beside an edge find the other face.
   * 1 = the paper. 0: points next to an edge are never drawn onto it. */
  double normal_weight_floor = 0.15;

  /** Project the repulsion on the sample's own tangent plane too, and leave it out of the last three iterations: otherwise points near
   * a sharp edge are pushed along the other face into the air. False: eq. 10 as printed. */
  bool own_tangent_repulsion = true;

  /** Share of input points that seed X^0, 0 < ratio <= 1; 1 keeps every point in order. */
  double sample_ratio = 1.0;

  /** Seed of the random choice of X^0. */
  std::uint64_t seed = 0;

  /** Largest number of iterations, 0 .. 10000; 0 copies. */
  unsigned maximum_iterations = 5;

  /** Stops when the mean movement of an iteration is below this share of h, >= 0; 0 = always run to the maximum. */
  double convergence_threshold = 1e-4;

  /** Rounds of gap filling after the iterations, 0 .. 100 (limitation iii, Fig. 21): points piled up on sharp edges spread over the empty
   * bands beside them. They move sideways, with their colours. 0 = none; 2 settle. */
  unsigned gap_iterations = 0;

  /** Length of the strips over which they spread, in h / 2, which is about the width of an empty band; 1 .. 8. Too small: the band is filled from
   * too few points. Too large: faces narrower than this, curved edges and corners are taken for straight ones. */
  double gap_radius_factor = 2.0;

  /** Where a data ball holds more points than this, means of neighbouring points that face the same way stand for them, at least half
   * as many as this; 0 = never. Bounds the time of dense clouds; sparse parts, whose balls hold fewer, are not changed at all.
   * Without effect where the recursion runs in double or has density weights. */
  unsigned merge_above = 200;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;

  /** \brief Algorithm 1 with its literal values: omega 0.02, sigma^2 0.004 updated by eq. 11, density weights, half of the points as
   * X^0, mu-hat 0.2, 30 iterations; h = 8 h0 (within the paper's 3 h0 .. 12 h0) when support_radius stays 0. */
  PCL_GPF_CORE_EXPORT static GPFParameters
  paper();
};

/** \brief Whether the recursion runs in double: when posteriors are normalised or sigma^2 moves. It amplifies rounding then (weights
 * differ by many powers of ten, a pair at the edge of the ball is in or out); fixed smooth weights are safe in float. */
PCL_GPF_CORE_EXPORT bool
runsInDouble(const GPFParameters& parameters);

/** \brief Checks every range. \throws InvalidParameter naming field, value and range */
PCL_GPF_CORE_EXPORT void
validate(const GPFParameters& parameters);

} // namespace pcl_gpf
