// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/surface/mls_points.h>

#include <pcl/surface/mls.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

using Mls = pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal>; // compiled in libpcl_surface

constexpr double kMostPoints = 1e8;
/** PCL numbers voxels by side^3 in 64 bits. */
constexpr double kMostVoxelsASide = 1 << 20;
/** Coordinates between which squares, and squares of those, stay floats. */
constexpr float kSmallestExtent = 1e-15f, kLargestExtent = 1e15f;

void
require(bool holds, const char* name, double value, const char* range)
{
  if (!holds || !std::isfinite(value))
    throw InvalidParameter(std::string("mls ") + name + " is " + std::to_string(value) + "; range: " + range);
}

/** \throws ExcessiveWork when more points may come out than anyone wants */
void
checkWork(const MLSUpsamplingParameters& p, std::size_t points, double extent)
{
  double made = static_cast<double>(points);
  const double grown = 2.0 * p.dilation_iterations + 1.0;
  if (p.method == MLSMethod::SampleLocalPlane)
    made *= std::pow(2.0 * p.upsampling_radius / p.upsampling_step + 1.0, 2);
  else if (p.method == MLSMethod::RandomUniformDensity)
    made *= std::max(1.0, p.density / 6.0); // a surface has at least 3 neighbours
  else if (p.method == MLSMethod::VoxelGridDilation)
    made *= grown * grown * grown;
  if (!(made <= kMostPoints))
    throw ExcessiveWork("moving least squares may make up to " + std::to_string(made) + " points of " +
                        std::to_string(points) + "; at most " + std::to_string(kMostPoints) +
                        " are made: ask for fewer points, or a wider step or voxel");
  if (p.method == MLSMethod::VoxelGridDilation && !(extent / p.voxel_size + grown < kMostVoxelsASide))
    throw ExcessiveWork("the cloud is " + std::to_string(extent / p.voxel_size) +
                        " voxels wide, at most a million can be numbered; ask for larger voxels");
}

/** \throws ExcessiveWork for a radius that holds so many points that PCL's fits take minutes */
void
refuseWideRadius(const MLSUpsamplingParameters& p, SoaBuffer positions, double extent)
{
  constexpr double kSecondsPerNeighbor = 2e-7; // found, sorted and summed up
  for (AlignedArray<float>* axis : {&positions.x, &positions.y, &positions.z})
    for (float& coordinate : *axis)
      coordinate = static_cast<float>(coordinate / extent);
  PlaneNormalsParameters ball;
  ball.radius = p.radius / extent;
  ball.merge_above = 0;
  ball.number_of_threads = p.number_of_threads;
  WorkEstimate work = estimateWork(ball, PointIndex(std::as_const(positions).view(), p.number_of_threads));
  work.parameter = "the radius of moving least squares";
  work.nominal_seconds = kSecondsPerNeighbor * work.pairs;
  work.seconds = work.nominal_seconds / static_cast<double>(resolveThreads(p.number_of_threads));
  refuseExcessiveWork(work);
}

/** Fills in what is estimated. \throws UnsuitableData, ExcessiveWork */
MLSUpsamplingParameters
effectiveParameters(MLSUpsamplingParameters p, const pcl::PointCloud<pcl::PointXYZ>& points)
{
  SoaBuffer positions(points.size());
  float extent = 0.0f;
  for (std::size_t i = 0; i < points.size(); ++i) {
    positions.x[i] = points[i].x;
    positions.y[i] = points[i].y;
    positions.z[i] = points[i].z;
    extent = std::max({extent, std::abs(points[i].x), std::abs(points[i].y), std::abs(points[i].z)});
  }
  if (extent > 0.0f && !(extent >= kSmallestExtent && extent <= kLargestExtent))
    throw UnsuitableData("moving least squares work in float, which cannot hold the squares of lengths below 1e-15 or above "
                         "1e15; change the unit of the coordinates");
  const PointsView view = static_cast<const SoaBuffer&>(positions).view();
  if (!spansSurface(view))
    throw UnsuitableData(std::to_string(points.size()) +
                         " points that coincide or lie on one line, or fewer than 3, have no surface");
  const double spacing = estimateSpacing(view, p.number_of_threads);
  const auto estimate = [spacing](double& length, double spacings) {
    if (length == 0.0)
      length = spacings * spacing;
  };
  estimate(p.radius, 4.0);
  estimate(p.upsampling_radius, 1.0);
  estimate(p.upsampling_step, 0.5);
  estimate(p.voxel_size, 1.0);
  if (p.density == 0.0)
    p.density = 5.0 * std::acos(-1.0) * (p.radius / spacing) * (p.radius / spacing);
  checkWork(p, points.size(), 2.0 * static_cast<double>(extent));
  refuseWideRadius(p, std::move(positions), static_cast<double>(extent));
  return p;
}

Mls::UpsamplingMethod
methodOfPcl(MLSMethod method)
{
  switch (method) {
    case MLSMethod::SampleLocalPlane: return Mls::SAMPLE_LOCAL_PLANE;
    case MLSMethod::VoxelGridDilation: return Mls::VOXEL_GRID_DILATION;
    case MLSMethod::RandomUniformDensity: // PCL's generator cannot be seeded; only its fits are used
    case MLSMethod::None: break;
  }
  return Mls::NONE;
}

void
append(const pcl::MLSResult::MLSProjectionResults& projected, float curvature, std::size_t source, MLSPoints& made)
{
  pcl::PointNormal point;
  point.getVector3fMap() = projected.point.cast<float>();
  point.getNormalVector3fMap() = projected.normal.cast<float>();
  point.curvature = curvature;
  made.points.push_back(point);
  made.sources.push_back(static_cast<std::uint32_t>(source));
}

/** PCL's random mode with a generator for each point, so that neither the run nor the number of threads matters. */
void
sampleRandomly(const MLSUpsamplingParameters& p, const std::vector<pcl::MLSResult>& surfaces, MLSPoints& made)
{
  const int coefficients = static_cast<int>((p.order + 1) * (p.order + 2) / 2);
  const double reach = p.radius / 2.0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const pcl::MLSResult& surface = surfaces[i];
    if (!surface.valid)
      continue;
    const auto wanted = static_cast<std::size_t>(p.density / 2.0 / surface.num_neighbors);
    if (wanted == 0) {
      append(surface.projectQueryPoint(pcl::MLSResult::SIMPLE, coefficients), surface.curvature, i, made);
      continue;
    }
    SplitMix64 random(p.seed + 0x632be59bd9b4e019ull * (i + 1));
    for (std::size_t added = 0; added < wanted;) {
      const double u = (2.0 * random.uniform() - 1.0) * reach, v = (2.0 * random.uniform() - 1.0) * reach;
      if (u * u + v * v > reach * reach)
        continue;
      const bool curved = p.order > 1 && surface.num_neighbors >= 5 * coefficients;
      append(curved ? surface.projectPointSimpleToPolynomialSurface(u, v) : surface.projectPointToMLSPlane(u, v),
             surface.curvature, i, made);
      ++added;
    }
  }
}

/** PCL's output in ascending order of its sources: threads deliver theirs in any order, but each point's own in one
 * piece. */
void
takeSorted(const pcl::PointCloud<pcl::PointNormal>& output, const pcl::Indices& sources, MLSPoints& made)
{
  std::vector<std::size_t> order(output.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sources[a] < sources[b]; });
  for (const std::size_t k : order) {
    made.points.push_back(output[k]);
    made.sources.push_back(static_cast<std::uint32_t>(sources[k]));
  }
}

} // namespace

void
validate(const MLSUpsamplingParameters& p)
{
  require(p.radius >= 0.0, "radius", p.radius, ">= 0, 0 = estimated");
  require(p.order <= 5, "order", p.order, "0 .. 5");
  require(p.upsampling_radius >= 0.0, "upsampling radius", p.upsampling_radius, ">= 0, 0 = estimated");
  require(p.upsampling_step >= 0.0, "upsampling step", p.upsampling_step, ">= 0, 0 = estimated");
  require(p.density >= 0.0, "density", p.density, ">= 0, 0 = estimated");
  require(p.voxel_size >= 0.0, "voxel size", p.voxel_size, ">= 0, 0 = estimated");
  require(p.dilation_iterations <= 16, "dilation iterations", p.dilation_iterations, "0 .. 16");
}

MLSPoints
upsampleByMls(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points, const MLSUpsamplingParameters& wanted)
{
  validate(wanted);
  const MLSUpsamplingParameters p = effectiveParameters(wanted, *points);
  Mls mls;
  mls.setInputCloud(points);
  mls.setComputeNormals(true);
  mls.setPolynomialOrder(static_cast<int>(p.order));
  mls.setSearchRadius(p.radius);
  mls.setUpsamplingMethod(methodOfPcl(p.method));
  mls.setUpsamplingRadius(p.upsampling_radius);
  mls.setUpsamplingStepSize(p.upsampling_step);
  mls.setDilationVoxelSize(static_cast<float>(p.voxel_size));
  mls.setDilationIterations(static_cast<int>(p.dilation_iterations));
  mls.setNumberOfThreads(static_cast<unsigned>(resolveThreads(p.number_of_threads))); // PCL takes 0 for 1
  mls.setCacheMLSResults(true); // without, several threads write to one result
  pcl::PointCloud<pcl::PointNormal> output;
  mls.process(output);

  MLSPoints made;
  made.radius = p.radius;
  const std::vector<pcl::MLSResult>& surfaces = mls.getMLSResults();
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (!surfaces[i].valid)
      made.dropped.push_back(static_cast<std::uint32_t>(i));
  if (p.method == MLSMethod::RandomUniformDensity)
    sampleRandomly(p, surfaces, made);
  else
    takeSorted(output, mls.getCorrespondingIndices()->indices, made);
  return made;
}

} // namespace pcl_gpf
