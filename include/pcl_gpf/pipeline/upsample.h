// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/operators/edge_aware_upsampling.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief How a cloud is made denser. */
enum class UpsamplingMethod {
  EdgeAware,         ///< EAR's insertion: the input stays, edges become sharper
  MovingLeastSquares ///< random points on PCL's fitted polynomials: smooth, edges round off, no input point remains
};

/** \brief Parameters of upsample(); lengths in cloud units. */
struct UpsampleParameters {
  UpsamplingMethod method = UpsamplingMethod::EdgeAware;
  /** Target and threads of both methods; `radius`, too: 0 = 3 spacings for the edge-aware one, 4 for moving least squares. */
  EdgeAwareUpsamplingParameters edge_aware;
  unsigned mls_order = 2;     ///< degree of the polynomials, 0 .. 5
  std::uint64_t mls_seed = 0; ///< of the random places
};

/** \brief The points that upsample() made; coordinates in double, in the frame and unit of the input. */
struct UpsampleResult {
  std::vector<double> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<std::uint32_t> parents; ///< row of the input that each takes its other fields from
  bool keeps_input = true;            ///< the rows of the input belong to the result, before these points

  std::vector<float> input_normal_x, input_normal_y, input_normal_z; ///< those used, one per row, NaN in rows that are not finite
  std::size_t estimated_normals = 0; ///< rows whose normal the input did not have
  std::size_t non_finite_points = 0;
  std::size_t dropped_points = 0;    ///< moving least squares: points with fewer than 3 neighbours
  double spacing = 0;                ///< of the input, cloud units
  double radius = 0;                 ///< that was used, cloud units
  double widest_gap = 0;             ///< edge-aware: that is left, cloud units
  std::size_t rounds = 0;            ///< edge-aware
  bool target_reached = true;
  double seconds_normals = 0;
  double seconds_upsampling = 0;
};

/** \brief Refuses what upsample() would refuse, a small part of its time. \throws InvalidParameter, UnsuitableData, ExcessiveWork */
PCL_GPF_EXPORT void
checkUpsamplable(const DenoiseInput& input, const UpsampleParameters& parameters);

/** \brief Makes a cloud given in double coordinates denser, every finite point; rows that are not finite are left out.
 *
 * Normals that the input does not have are estimated: plane fits, then the bilateral normal filter.
 * \throws InvalidParameter (also when the target lies below the number of finite points), UnsuitableData (fewer than 3 finite
 * points, or all on one line), ExcessiveWork, Cancelled; the first three before the work
 * Thread safety: free function without shared state.
 */
PCL_GPF_EXPORT UpsampleResult
upsample(const DenoiseInput& input, const UpsampleParameters& parameters, const StageProgress& progress = {});

} // namespace pcl_gpf
