// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/pipeline/denoise.h>
#include <pcl_gpf/pipeline/mesh.h>
#include <pcl_gpf/pipeline/upsample.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_gpf {

/** \brief Which stages consolidate() runs, in this order, and their parameters; lengths in cloud units. */
struct ConsolidationParameters {
  bool normals = false;  ///< estimate all normals anew; without it those of the input are used where it has them
  bool filter = true;    ///< plane normals where they are missing, bilateral normal filter, GPF
  bool orient = true;    ///< consistent signs of the normals
  bool upsample = false; ///< denser; twice as many points unless `upsampling` says otherwise
  bool mesh = true;

  DenoiseParameters denoise; ///< of the stages normals and filter
  NormalOrientationParameters orientation;
  UpsampleParameters upsampling;
  MeshParameters meshing; ///< after the stage orient the mesher takes the normals as they are
  std::optional<std::array<double, 3>> viewpoint; ///< for the orientation, cloud units
  unsigned number_of_threads = 0;                 ///< for all stages, whatever their own structs say; 0 = all that the process may use
};

/** \brief Checks every range and that there is a stage. \throws InvalidParameter */
PCL_GPF_EXPORT void
validate(const ConsolidationParameters& parameters);

/** \brief Points with normals; coordinates in double, in the frame and unit of the input. */
struct ConsolidatedCloud {
  std::vector<double> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z; ///< unit length; NaN where no stage gave one
  std::vector<std::uint32_t> source_rows;          ///< row of the input that each takes its other fields from

  std::size_t size() const { return x.size(); }
  DenoiseInput view() const { return {x.data(), y.data(), z.data(), size(), normal_x.data(), normal_y.data(), normal_z.data()}; }
};

/** \brief Wall time of the stages. */
struct ConsolidationSeconds {
  double check = 0;   ///< what can be refused before the work
  double normals = 0; ///< scale, plane fits and bilateral filter, those of the stages orient and upsample included
  double filter = 0;
  double orient = 0;
  double upsample = 0;
  double mesh = 0;
  double total = 0;
};

/** \brief What consolidate() made. */
struct ConsolidationResult {
  ConsolidatedCloud points;    ///< after the stages normals, filter and orient: finite rows of the input, ascending
  ConsolidatedCloud upsampled; ///< empty without that stage; begins with `points`, unless the method is MovingLeastSquares
  MeshResult mesh;             ///< empty without that stage; `source_rows` are rows of the input of consolidate()

  DenoiseResult denoise;       ///< statistics only, the arrays are in `points`
  NormalOrientationStatistics orientation; ///< noise in cloud units
  UpsampleResult upsampling;   ///< statistics only, the arrays are in `upsampled`
  std::size_t non_finite_points = 0; ///< rows of the input that are left out
  std::size_t estimated_normals = 0; ///< points whose normal the input did not have
  ConsolidationSeconds seconds;
};

/** \brief The whole chain on a cloud in double coordinates: normals, filter, orientation, upsampling and mesh.
 *
 * Each stage is the function of its own header (denoise.h, orient.h, upsample.h, mesh.h) on what the one before made.
 * \param[in] progress called with the stage ("normals", "bilateral", "filter", ..., "orient", "upsampling", "mesh") and the
 * fraction done of the whole run, which never falls and is 1 in the last call; each stage counts with its expected time. False cancels
 * \throws InvalidParameter, UnsuitableData, ExcessiveWork (a target or resolution beyond what there is room for), all three before
 * the work wherever the input tells; Cancelled
 * Thread safety: free function without shared state.
 */
PCL_GPF_EXPORT ConsolidationResult
consolidate(const DenoiseInput& input, const ConsolidationParameters& parameters, const StageProgress& progress = {});

} // namespace pcl_gpf
