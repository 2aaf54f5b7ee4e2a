// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/core/operators/rimls_mesh.h>
#include <pcl_gpf/pipeline/denoise.h>
#include <pcl_gpf/surface/poisson_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Which surface is meshed. */
enum class MeshMethod {
  Rimls,  ///< robust implicit moving least squares: sharp edges, ends where the points do
  Poisson ///< screened Poisson (PCL's): smooth, closes gaps
};

/** \brief What is done about the signs of normals. */
enum class MeshOrientation {
  Auto, ///< orient them if they contradict each other
  Keep, ///< use them as they are
  Orient
};

/** \brief Parameters of meshCloud(); lengths in cloud units. */
struct MeshParameters {
  MeshMethod method = MeshMethod::Rimls;
  RimlsMeshParameters rimls;     ///< read for MeshMethod::Rimls
  PoissonMeshParameters poisson; ///< read for MeshMethod::Poisson
  MeshOrientation orientation = MeshOrientation::Auto;
  NormalOrientationParameters orient;
  unsigned number_of_threads = 0; ///< for all steps; 0 = all that the process may use
};

/** \brief A mesh in the frame and unit of the input. */
struct MeshResult {
  std::vector<double> vertices;           ///< x y z per vertex
  std::vector<float> normals;             ///< x y z per vertex, unit length
  std::vector<std::uint32_t> triangles;   ///< 3 vertices each, counterclockwise seen from outside
  std::vector<std::uint32_t> source_rows; ///< per vertex the nearest input row on the same side of the edge

  std::size_t points = 0;                ///< that made the surface
  std::size_t points_without_normal = 0; ///< left out
  std::size_t non_finite_points = 0;     ///< left out
  double inconsistent_normals = 0;       ///< share of the input's normals against their surface; measured for MeshOrientation::Auto
  bool oriented = false;
  NormalOrientationStatistics orientation; ///< when oriented
  RimlsMeshStatistics rimls;               ///< when MeshMethod::Rimls; lengths in cloud units
  std::size_t open_edges = 0;              ///< 0 for a closed surface
  std::size_t components = 0;
  double seconds_orient = 0;
  double seconds_mesh = 0;
};

/** \brief Refuses what meshCloud() would refuse for the positions alone, normals may be missing yet; a small part of its time.
 * \throws InvalidParameter, UnsuitableData, ExcessiveWork */
PCL_GPF_EXPORT void
checkMeshable(const DenoiseInput& input, const MeshParameters& parameters);

/** \brief Meshes a cloud with normals given in double coordinates. Stages of the progress: "orient" and "mesh".
 *
 * Rows that are not finite or have no normal are left out.
 * \param[in] input with normals \param[in] viewpoint for the orientation, cloud units, or null
 * \throws InvalidParameter (no normals; a range), UnsuitableData (nothing finite, fewer than 4 points, all points in one place or on one line),
 * ExcessiveWork naming the memory that the resolution takes or the work of a wide support, before the work starts, Cancelled
 * \note MeshMethod::Poisson can be cancelled before and after PCL's part only.
 */
PCL_GPF_EXPORT MeshResult
meshCloud(const DenoiseInput& input,
          const MeshParameters& parameters,
          const std::array<double, 3>* viewpoint = nullptr,
          const StageProgress& progress = {});

} // namespace pcl_gpf
