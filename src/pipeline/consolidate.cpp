// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/consolidate.h>
#include <pcl_gpf/pipeline/orient.h>

#include "overall_progress.h"
#include "stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

/** Every stage says that it begins, so that each can be cancelled there, whatever is inside. */
void
beginStage(const StageProgress& progress, const char* name)
{
  if (progress && !progress(name, 0.0))
    throw Cancelled();
}

ConsolidationParameters
withThreads(ConsolidationParameters p)
{
  p.denoise.number_of_threads = p.orientation.number_of_threads = p.upsampling.edge_aware.number_of_threads =
      p.meshing.number_of_threads = p.number_of_threads;
  if (p.orient)
    p.meshing.orientation = MeshOrientation::Keep;
  p.meshing.orient = p.orientation;
  return p;
}

/** Finite rows with the normals of the input, NaN where there are none. */
ConsolidatedCloud
finitePoints(const DenoiseInput& input, bool with_normals)
{
  ConsolidatedCloud cloud;
  for (std::size_t i = 0; i < input.size; ++i)
    if (std::isfinite(input.x[i]) && std::isfinite(input.y[i]) && std::isfinite(input.z[i]))
      cloud.source_rows.push_back(static_cast<std::uint32_t>(i));
  const auto take = [&cloud](const auto* column, auto missing, auto& values) {
    values.assign(cloud.source_rows.size(), missing);
    for (std::size_t k = 0; column && k < values.size(); ++k)
      values[k] = column[cloud.source_rows[k]];
  };
  take(input.x, 0.0, cloud.x);
  take(input.y, 0.0, cloud.y);
  take(input.z, 0.0, cloud.z);
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  take(with_normals ? input.normal_x : nullptr, kMissing, cloud.normal_x);
  take(with_normals ? input.normal_y : nullptr, kMissing, cloud.normal_y);
  take(with_normals ? input.normal_z : nullptr, kMissing, cloud.normal_z);
  return cloud;
}

/** Refuses what the input alone tells. */
void
check(const DenoiseInput& input, const ConsolidationParameters& p)
{
  const bool makes_normals = p.normals || p.filter || p.orient || p.upsample;
  if (p.mesh && !makes_normals && !input.normal_x)
    throw InvalidParameter("the input has no normals, which the mesh needs; add the stage normals, filter or orient");
  if (p.denoise.gpf.sample_ratio < 1.0 && p.filter)
    return; // what comes after works on fewer points
  if (p.upsample)
    checkUpsamplable(input, p.upsampling);
  if (p.mesh)
    checkMeshable(input, p.meshing);
}

/** Longest side of the box of the finite rows. */
double
longestSide(const DenoiseInput& input)
{
  double side = 0.0;
  for (const double* axis : {input.x, input.y, input.z}) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < input.size; ++i)
      if (std::isfinite(axis[i])) {
        least = std::min(least, axis[i]);
        most = std::max(most, axis[i]);
      }
    side = std::max(side, most - least);
  }
  return side;
}

void
moveNormals(std::vector<float>& x, std::vector<float>& y, std::vector<float>& z, ConsolidatedCloud& cloud)
{
  cloud.normal_x = std::move(x);
  cloud.normal_y = std::move(y);
  cloud.normal_z = std::move(z);
}

/** The stages normals and filter. */
void
denoiseStage(const DenoiseInput& input, const ConsolidationParameters& p, const StageProgress& progress, ConsolidationResult& result)
{
  DenoiseInput from = input;
  if (p.normals)
    from.normal_x = from.normal_y = from.normal_z = nullptr;
  ConsolidatedCloud& cloud = result.points;
  if (p.filter) {
    result.denoise = denoise(from, p.denoise, progress);
    cloud.x = std::move(result.denoise.x);
    cloud.y = std::move(result.denoise.y);
    cloud.z = std::move(result.denoise.z);
    cloud.source_rows = std::move(result.denoise.sample_indices);
    moveNormals(result.denoise.normal_x, result.denoise.normal_y, result.denoise.normal_z, cloud);
  } else {
    cloud = finitePoints(from, true);
    if (p.normals) {
      result.denoise = denoiseNormals(cloud.view(), p.denoise, progress);
      moveNormals(result.denoise.normal_x, result.denoise.normal_y, result.denoise.normal_z, cloud);
    }
  }
  result.estimated_normals = result.denoise.estimated_normals;
  result.seconds.normals = result.denoise.seconds_normals + result.denoise.seconds_bilateral;
  result.seconds.filter = result.denoise.seconds_filter;
}

void
orientStage(const ConsolidationParameters& p, const StageProgress& progress, ConsolidationResult& result)
{
  beginStage(progress, "orient");
  const Stopwatch watch;
  OrientResult oriented = orientCloud(result.points.view(), p.orientation, p.viewpoint ? &*p.viewpoint : nullptr, progress);
  moveNormals(oriented.normal_x, oriented.normal_y, oriented.normal_z, result.points);
  result.orientation = oriented.orientation;
  result.estimated_normals += oriented.estimated_normals;
  result.seconds.normals += oriented.seconds_normals;
  result.seconds.orient = watch.elapsed() - oriented.seconds_normals;
}

void
upsampleStage(const ConsolidationParameters& p, const StageProgress& progress, ConsolidationResult& result)
{
  beginStage(progress, "upsampling");
  const Stopwatch watch;
  ConsolidatedCloud& before = result.points;
  UpsampleResult& made = result.upsampling = upsample(before.view(), p.upsampling, progress);
  moveNormals(made.input_normal_x, made.input_normal_y, made.input_normal_z, before);
  ConsolidatedCloud& after = result.upsampled;
  if (made.keeps_input)
    after = before;
  const auto append = [](auto& values, auto& to) {
    to.insert(to.end(), values.begin(), values.end());
    values = {};
  };
  for (std::uint32_t& parent : made.parents)
    parent = before.source_rows[parent];
  append(made.x, after.x);
  append(made.y, after.y);
  append(made.z, after.z);
  append(made.normal_x, after.normal_x);
  append(made.normal_y, after.normal_y);
  append(made.normal_z, after.normal_z);
  append(made.parents, after.source_rows);
  result.estimated_normals += made.estimated_normals;
  result.seconds.normals += made.seconds_normals;
  result.seconds.upsample = watch.elapsed() - made.seconds_normals;
}

void
meshStage(const ConsolidationParameters& p, const StageProgress& progress, ConsolidationResult& result)
{
  beginStage(progress, "mesh");
  const ConsolidatedCloud& cloud = p.upsample ? result.upsampled : result.points;
  result.mesh = meshCloud(cloud.view(), p.meshing, p.viewpoint ? &*p.viewpoint : nullptr, progress);
  for (std::uint32_t& row : result.mesh.source_rows)
    row = cloud.source_rows[row];
  result.seconds.orient += result.mesh.seconds_orient;
  result.seconds.mesh = result.mesh.seconds_mesh;
}

} // namespace

void
validate(const ConsolidationParameters& p)
{
  if (!(p.normals || p.filter || p.orient || p.upsample || p.mesh))
    throw InvalidParameter("no stage is chosen: normals, filter, orient, upsample or mesh");
  validate(p.denoise);
  validate(p.orientation);
  validate(p.upsampling.edge_aware);
  validate(p.meshing.rimls);
  validate(p.meshing.poisson);
  for (std::size_t axis = 0; p.viewpoint && axis < 3; ++axis)
    if (!std::isfinite((*p.viewpoint)[axis]))
      throw InvalidParameter("the viewpoint is not finite");
}

ConsolidationResult
consolidate(const DenoiseInput& input, const ConsolidationParameters& wanted, const StageProgress& callback)
{
  const Stopwatch watch;
  validate(wanted);
  const ConsolidationParameters p = withThreads(wanted);
  ConsolidationResult result;
  check(input, p);
  result.seconds.check = watch.elapsed();
  OverallProgress whole(expectedStages(p, input.size, longestSide(input)), callback);
  const auto report = [&whole](const std::string& stage, double fraction) { return whole.report(stage, fraction); };
  const StageProgress progress = callback ? StageProgress(report) : StageProgress();
  denoiseStage(input, p, progress, result);
  result.non_finite_points =
      p.filter ? result.denoise.non_finite_points : input.size - result.points.size();
  if (p.orient)
    orientStage(p, progress, result);
  if (p.upsample)
    upsampleStage(p, progress, result);
  if (p.mesh)
    meshStage(p, progress, result);
  if (callback && !whole.finish())
    throw Cancelled();
  result.seconds.total = watch.elapsed();
  return result;
}

} // namespace pcl_gpf
