// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/orient.h>

#include "packed_cloud.h"

#include <chrono>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

ProgressCallback
stageOf(const char* name, const StageProgress& progress)
{
  if (!progress)
    return {};
  return [name, &progress](double fraction) { return progress(name, fraction); };
}

/** Plane fits where normals are missing; filtered when they all are. */
void
fillNormals(Packed& packed, unsigned number_of_threads, const StageProgress& progress)
{
  PlaneNormalsParameters planes;
  BilateralNormalsParameters bilateral;
  GPFParameters unused;
  planes.number_of_threads = bilateral.number_of_threads = number_of_threads;
  estimateParameters(measureScale(*packed.index, number_of_threads), planes, bilateral, unused);
  if (progress && !progress("normals", 0.0))
    throw Cancelled();
  SoaBuffer estimated(packed.rows.size());
  estimatePlaneNormals(planes, *packed.index, estimated.view());
  for (const std::uint32_t k : packed.missing_normals) {
    packed.normals.x[k] = estimated.x[k];
    packed.normals.y[k] = estimated.y[k];
    packed.normals.z[k] = estimated.z[k];
  }
  if (packed.missing_normals.size() == packed.rows.size())
    filterNormalsBilaterally(bilateral, *packed.index, packed.normals.view(), {}, stageOf("bilateral", progress));
}

} // namespace

OrientResult
orientCloud(const DenoiseInput& input, const NormalOrientationParameters& wanted,
            const std::array<double, 3>* viewpoint, const StageProgress& progress)
{
  validate(wanted);
  if (viewpoint)
    for (const double coordinate : *viewpoint)
      if (!std::isfinite(coordinate))
        throw InvalidParameter("the viewpoint is not finite");
  const auto start = std::chrono::steady_clock::now();
  NormalOrientationParameters parameters = wanted;
  Packed packed = packPositions(input, false, parameters.number_of_threads);
  packNormals(input, packed);
  OrientResult result;
  result.non_finite_points = input.size - packed.rows.size();
  result.estimated_normals = packed.missing_normals.size();
  if (!packed.missing_normals.empty())
    fillNormals(packed, parameters.number_of_threads, progress);
  result.seconds_normals = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  parameters.noise = packed.frame.lengthToLocal(parameters.noise);
  std::array<double, 3> local_viewpoint{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; viewpoint && axis < 3; ++axis)
    local_viewpoint[axis] = ((*viewpoint)[axis] - packed.frame.origin[axis]) / packed.frame.scale;
  result.orientation = orientNormals(parameters, *packed.index, packed.normals.view(),
                                     viewpoint ? &local_viewpoint : nullptr, stageOf("orient", progress));
  result.orientation.noise = packed.frame.lengthToWorld(result.orientation.noise);

  const auto spread = [&](const AlignedArray<float>& from, std::vector<float>& to) {
    to.assign(input.size, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t k = 0; k < packed.rows.size(); ++k)
      to[packed.rows[k]] = from[k];
  };
  spread(packed.normals.x, result.normal_x);
  spread(packed.normals.y, result.normal_y);
  spread(packed.normals.z, result.normal_z);
  return result;
}

} // namespace pcl_gpf
