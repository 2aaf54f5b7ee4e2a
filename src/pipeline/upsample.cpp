// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/upsample.h>
#include <pcl_gpf/surface/mls_points.h>

#include "packed_cloud.h"
#include "stopwatch.h"

#include <cmath>
#include <limits>
#include <string>

namespace pcl_gpf {

namespace {

/** Normals of all rows: those of the input, and estimated ones in place of those that it does not have. */
void
completeNormals(const DenoiseInput& input, Packed& packed, unsigned threads, const StageProgress& progress, UpsampleResult& result)
{
  packNormals(input, packed);
  result.estimated_normals = packed.missing_normals.size();
  if (!packed.missing_normals.empty()) {
    DenoiseParameters parameters;
    parameters.number_of_threads = threads;
    const DenoiseResult estimated = denoiseNormals(input, parameters, progress);
    for (const std::uint32_t k : packed.missing_normals) {
      packed.normals.x[k] = estimated.normal_x[packed.rows[k]];
      packed.normals.y[k] = estimated.normal_y[packed.rows[k]];
      packed.normals.z[k] = estimated.normal_z[packed.rows[k]];
    }
  }
  const auto spread = [&](const AlignedArray<float>& from, std::vector<float>& to) {
    to.assign(input.size, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t k = 0; k < packed.rows.size(); ++k)
      to[packed.rows[k]] = from[k];
  };
  spread(packed.normals.x, result.input_normal_x);
  spread(packed.normals.y, result.input_normal_y);
  spread(packed.normals.z, result.input_normal_z);
}

void
fillGaps(const DenoiseInput& input, const Packed& packed, EdgeAwareUpsamplingParameters parameters,
         const StageProgress& progress, UpsampleResult& result)
{
  parameters.radius = packed.frame.lengthToLocal(parameters.radius);
  parameters.spacing = packed.frame.lengthToLocal(parameters.spacing);
  const PointsView points = packed.index->sorted();
  const auto report = [&progress](double fraction) { return !progress || progress("upsampling", fraction); };
  const EdgeAwareUpsamplingResult made = upsampleEdgeAware(parameters, *packed.index, packed.normals.view(),
                                                           packed.frame.lengthToLocal(result.spacing), report);
  result.radius = packed.frame.lengthToWorld(made.radius);
  result.widest_gap = packed.frame.lengthToWorld(made.widest_gap);
  result.rounds = made.rounds;
  result.target_reached = made.target_reached;
  const std::size_t count = made.parents.size();
  result.parents.resize(count);
  // From the parent's own coordinates, so that no digit of a distant origin is lost.
  const auto place = [&](const double* column, const float* from, const AlignedArray<float>& to, std::vector<double>& values) {
    values.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double moved = static_cast<double>(to[k]) - static_cast<double>(from[made.parents[k]]);
      values[k] = column[packed.rows[made.parents[k]]] + packed.frame.lengthToWorld(moved);
    }
  };
  place(input.x, points.x, made.points.x, result.x);
  place(input.y, points.y, made.points.y, result.y);
  place(input.z, points.z, made.points.z, result.z);
  for (std::size_t k = 0; k < count; ++k)
    result.parents[k] = packed.rows[made.parents[k]];
  result.normal_x.assign(made.normals.x.begin(), made.normals.x.end());
  result.normal_y.assign(made.normals.y.begin(), made.normals.y.end());
  result.normal_z.assign(made.normals.z.begin(), made.normals.z.end());
}

void
sampleSurfaces(const DenoiseInput& input, const Packed& packed, const UpsampleParameters& parameters, double factor,
               UpsampleResult& result)
{
  result.keeps_input = false;
  std::vector<std::uint32_t> rows(packed.rows); // ascending: the seeds of the random places follow the rows
  std::sort(rows.begin(), rows.end());
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  const std::array<double, 3>& origin = packed.frame.origin;
  for (const std::uint32_t row : rows)
    points->push_back(pcl::PointXYZ(static_cast<float>(input.x[row] - origin[0]), static_cast<float>(input.y[row] - origin[1]),
                                    static_cast<float>(input.z[row] - origin[2])));
  MLSUpsamplingParameters mls;
  mls.method = MLSMethod::RandomUniformDensity;
  mls.radius = parameters.edge_aware.radius > 0.0 ? parameters.edge_aware.radius : 4.0 * result.spacing;
  mls.order = parameters.mls_order;
  // PCL puts density / 2 / neighbours points, rounded down, in place of each.
  const double neighbors = std::acos(-1.0) * (mls.radius / result.spacing) * (mls.radius / result.spacing);
  mls.density = 2.0 * (factor + 0.5) * neighbors;
  mls.seed = parameters.mls_seed;
  mls.number_of_threads = parameters.edge_aware.number_of_threads;
  const MLSPoints made = upsampleByMls(points, mls);
  result.radius = made.radius;
  result.dropped_points = made.dropped.size();
  if (made.points.empty())
    throw UnsuitableData("no point has 3 neighbours within the radius of moving least squares; choose a larger radius");
  for (std::size_t k = 0; k < made.points.size(); ++k) {
    const pcl::PointNormal& p = made.points[k];
    const std::uint32_t row = rows[made.sources[k]];
    const double side = static_cast<double>(p.normal_x) * static_cast<double>(result.input_normal_x[row]) +
                        static_cast<double>(p.normal_y) * static_cast<double>(result.input_normal_y[row]) +
                        static_cast<double>(p.normal_z) * static_cast<double>(result.input_normal_z[row]);
    const float sign = side < 0.0 ? -1.0f : 1.0f;
    result.x.push_back(static_cast<double>(p.x) + origin[0]);
    result.y.push_back(static_cast<double>(p.y) + origin[1]);
    result.z.push_back(static_cast<double>(p.z) + origin[2]);
    result.normal_x.push_back(sign * p.normal_x);
    result.normal_y.push_back(sign * p.normal_y);
    result.normal_z.push_back(sign * p.normal_z);
    result.parents.push_back(row);
  }
}

/** The target as a multiple of the input, for a method that reaches it only roughly. */
double
factorOf(const EdgeAwareUpsamplingParameters& p, std::size_t input, double spacing)
{
  if (p.spacing > 0.0)
    return std::max(1.0, (spacing / p.spacing) * (spacing / p.spacing));
  return static_cast<double>(targetCount(p, input)) / static_cast<double>(input);
}

/** What can be refused before the work. */
void
requireRoomToFill(const Packed& packed, const UpsampleParameters& p)
{
  EdgeAwareUpsamplingParameters parameters = p.edge_aware;
  const std::size_t count = packed.rows.size();
  if (count < 3)
    throw UnsuitableData(std::to_string(count) + " finite points make no surface to fill; it takes 3");
  if (!spansSurface(packed.index->sorted()))
    throw UnsuitableData("the " + std::to_string(count) + " finite points lie on one line; there is no surface to fill");
  targetCount(parameters, count);
  parameters.radius = packed.frame.lengthToLocal(parameters.radius);
  parameters.spacing = packed.frame.lengthToLocal(parameters.spacing);
  if (p.method == UpsamplingMethod::EdgeAware && parameters.radius > 0.0)
    refuseExcessiveWork(estimateWork(parameters, *packed.index));
}

} // namespace

void
checkUpsamplable(const DenoiseInput& input, const UpsampleParameters& parameters)
{
  validate(parameters.edge_aware);
  requireRoomToFill(packPositions(input, false, parameters.edge_aware.number_of_threads), parameters);
}

UpsampleResult
upsample(const DenoiseInput& input, const UpsampleParameters& parameters, const StageProgress& progress)
{
  validate(parameters.edge_aware);
  Stopwatch watch;
  UpsampleResult result;
  Packed packed = packPositions(input, false, parameters.edge_aware.number_of_threads);
  result.non_finite_points = input.size - packed.rows.size();
  requireRoomToFill(packed, parameters);
  result.spacing = packed.frame.lengthToWorld(estimateSpacing(*packed.index, parameters.edge_aware.number_of_threads));
  completeNormals(input, packed, parameters.edge_aware.number_of_threads, progress, result);
  result.seconds_normals = watch.lap();
  if (parameters.method == UpsamplingMethod::EdgeAware)
    fillGaps(input, packed, parameters.edge_aware, progress, result);
  else
    sampleSurfaces(input, packed, parameters, factorOf(parameters.edge_aware, packed.rows.size(), result.spacing), result);
  result.seconds_upsampling = watch.lap();
  return result;
}

} // namespace pcl_gpf
