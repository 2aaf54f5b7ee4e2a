// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/orient.h>

#include "packed_cloud.h"
#include "stopwatch.h"

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
  const Stopwatch watch;
  NormalOrientationParameters parameters = wanted;
  Packed packed = packPositions(input, false, parameters.number_of_threads);
  packNormals(input, packed);
  OrientResult result;
  result.non_finite_points = input.size - packed.rows.size();
  result.estimated_normals = packed.missing_normals.size();
  if (!packed.missing_normals.empty())
    fillNormals(packed, parameters.number_of_threads, progress);
  result.seconds_normals = watch.elapsed();

  parameters.noise = packed.frame.lengthToLocal(parameters.noise);
  std::array<double, 3> local_viewpoint{0.0, 0.0, 0.0};
  for (std::size_t axis = 0; viewpoint && axis < 3; ++axis)
    local_viewpoint[axis] = ((*viewpoint)[axis] - packed.frame.origin[axis]) / packed.frame.scale;
  result.orientation = orientNormals(parameters, *packed.index, packed.normals.view(),
                                     viewpoint ? &local_viewpoint : nullptr, stageOf("orient", progress));
  result.orientation.noise = packed.frame.lengthToWorld(result.orientation.noise);

  spreadNormals(packed, input.size, result.normal_x, result.normal_y, result.normal_z);
  return result;
}

} // namespace pcl_gpf
