// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/operators/gpf_parameters.h>
#include <pcl_gpf/core/operators/plane_normals.h>
#include <pcl_gpf/core/operators/quadric_fit.h>
#include <pcl_gpf/core/operators/steered_fit.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What denoise() finds out about the points beside filtering them. */
struct DenoiseFlags {
  bool outliers = true; ///< DenoiseResult::outlier; many of them are left out of the data of the others
  bool sigma = false;   ///< DenoiseResult::sigma; outliers do not count in it when they are known
  bool edges = false;   ///< DenoiseResult::edge
};

/** \brief Parameters of the chain plane normals -> bilateral normal filter -> GPF; 0 = estimated, lengths in cloud units. */
struct DenoiseParameters {
  PlaneNormalsParameters normals;
  BilateralNormalsParameters bilateral;
  GPFParameters gpf;

  /** Filter at two scales and take at each point the coarse result, or the fine one where the coarse one took detail away
   * (selectFineScale()). Only where all three radii are estimated, every point is kept and points move along normals (no repulsion, no
   * gap filling); otherwise one scale. */
  bool two_scales = true;

  /** Filter a third time with yet narrower balls where the two scales drew thin parts together (findThinParts()); only with two scales and
   * where noise is at most half of the spacing. */
  bool thin_parts = true;

  /** Planes over neighbourhoods that follow edges, fitted at the points that take the fine result; `passes` = 0: none. */
  SteeredFitParameters steered;

  /** Quadrics fitted in wide balls, to which points of smooth parts move at last; only where two scales are filtered. Noise and spacing
   * are those that are measured; `levels` = 0: none. */
  QuadricFitParameters quadric;

  /** Largest distance that a point may be moved, cloud units, >= 0; 0 = estimated as 6 times the noise, so that a clean cloud
   * stays as it is, and so do clouds of too few points (below 48, or a few hundred whose noise cannot be told from the shape).
   * Infinity = no limit. Not applied to the paper's recursion unless it is set. */
  double max_move = 0.0;

  /** Scales every length that comes from the noise, 0.5 .. 2: the noise is taken for this many times what was measured. Larger smooths
   * more; the part of each length that the spacing decides stays. */
  double strength = 1.0;

  /** What is found out beside the filtered points. */
  DenoiseFlags flags;

  unsigned number_of_threads = 0; ///< for all stages, whatever their own structs say; 0 = all that the process may use
};

/** \brief Checks every range. \throws InvalidParameter */
PCL_GPF_EXPORT void
validate(const DenoiseParameters& parameters);

/** \brief Coordinates in double, N values each, any may be NaN; and normals, N floats each or empty. */
struct DenoiseInput {
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  std::size_t size = 0;
  const float* normal_x = nullptr; ///< null: normals are estimated; zero and NaN normals are estimated one by one
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
};

/** \brief Filtered points, as many as there are samples; coordinates in double, in the frame and unit of the input. */
struct DenoiseResult {
  std::vector<double> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<std::uint32_t> sample_indices; ///< row of the input that seeded each output point, ascending
  std::vector<std::uint8_t> isolated;        ///< 1 = no data in reach but the point itself: nothing filtered it
  std::vector<std::uint8_t> fine;            ///< 1 = the fine or finest scale's result was taken; empty when one scale was filtered
  std::size_t finest_points = 0;             ///< points that took the finest scale's result
  static constexpr float kOutlier = 0.5f;    ///< points above are outliers
  std::vector<float> outlier;                ///< probability 0 .. 1 that the point is none of the surface (outlierProbabilities());
                                             ///< 0 below about 200 points, too few to tell
  std::vector<double> sigma;                 ///< noise that was taken out about the point, cloud units (localNoise())
  std::vector<std::uint8_t> edge;            ///< 1 = within h / 4 of a sharp edge of the filtered cloud (edgePoints())
  std::size_t limited_points = 0;            ///< points whose move was cut to `max_move`
  double max_move = 0;                       ///< the limit, cloud units; infinity = none, or none for the whole move where gaps were filled
  double max_iteration_move = 0;             ///< the same before gaps were filled

  bool repeated = false;                     ///< many outliers were in reach: the points with outlier <= 0.1 were filtered again by themselves;
                                             ///< scale, parameters and iterations are of that second run

  CloudScale scale;                          ///< of the input, cloud units
  std::vector<ParameterOrigin> parameters;   ///< effective values and where they came from, lengths in cloud units
  std::vector<IterationStats> iterations;    ///< of GPF; variance in the normalised frame, movements in cloud units
  std::vector<IterationStats> fine_iterations; ///< the same at the fine scale; empty where no point needs it
  std::vector<IterationStats> gap_iterations;  ///< rounds of gap filling (gpfFillGaps()); empty where none is asked for
  std::size_t non_finite_points = 0;
  std::size_t estimated_normals = 0;         ///< normals that the input did not have
  double seconds_normals = 0;
  double seconds_bilateral = 0;
  double seconds_filter = 0;
};

/** \brief Called with a stage and its fraction done; return false to cancel.
 *
 * Stages in order: "normals", "bilateral", "filter"; "gaps" where they are filled; with two scales then "fine normals", "fine bilateral",
 * "fine filter" and "fine planes" where the coarse one lost detail, "finest normals", ... where thin parts are, and "quadrics"; all of them
 * once more with "repeated " before where outliers are left out. */
using StageProgress = std::function<bool(const std::string& stage, double fraction)>;

/** \brief Filters a cloud given in double coordinates, every finite point by default; rows that are not finite are left out.
 *
 * A point that nothing moves keeps its coordinates to the last bit. Cost: O(points * points in the balls), about 10 us a point with two
 * scales on one thread; memory about 170 bytes a point above input and result (docs/benchmarks.md).
 * \throws InvalidParameter, UnsuitableData (nothing finite, all points identical), ExcessiveWork, Cancelled
 * Thread safety: free function without shared state.
 */
PCL_GPF_EXPORT DenoiseResult
denoise(const DenoiseInput& input, const DenoiseParameters& parameters, const StageProgress& progress = {});

/** \brief Only the first two steps: a unit normal for every finite point (NaN elsewhere), one per input row. */
PCL_GPF_EXPORT DenoiseResult
denoiseNormals(const DenoiseInput& input, const DenoiseParameters& parameters, const StageProgress& progress = {});

} // namespace pcl_gpf
