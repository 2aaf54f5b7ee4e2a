// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/nearest_source.h>
#include <pcl_gpf/core/analysis/orientation_check.h>
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/surface_mesh.h>
#include <pcl_gpf/pipeline/mesh.h>

#include "packed_cloud.h"
#include "stopwatch.h"

#include <string>
#include <utility>

namespace pcl_gpf {

namespace {

/** Share of contradicting normals from which on they are oriented. */
constexpr double kInconsistent = 0.02;

/** Finite rows with a normal, in the normalised frame. */
struct Samples {
  LocalFrame frame;
  std::vector<std::uint32_t> rows;
  SoaBuffer points, normals;
};

/** \throws UnsuitableData */
void
requireSurface(PointsView points, const char* which)
{
  constexpr std::size_t kFewestPoints = 4;
  if (points.size < kFewestPoints)
    throw UnsuitableData(std::to_string(points.size) + " " + which + " make no surface; it takes " + std::to_string(kFewestPoints));
  if (!spansSurface(points))
    throw UnsuitableData("the " + std::to_string(points.size) + " " + which + " lie on one line or in one place and make no surface");
}

Samples
packSamples(const DenoiseInput& input, unsigned threads, MeshResult& result)
{
  Packed packed = packPositions(input, false, threads);
  packNormals(input, packed);
  result.non_finite_points = input.size - packed.rows.size();
  result.points_without_normal = packed.missing_normals.size();
  Samples samples;
  samples.frame = packed.frame;
  std::vector<bool> missing(packed.rows.size());
  for (const std::uint32_t k : packed.missing_normals)
    missing[k] = true;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < packed.rows.size(); ++k)
    if (!missing[k])
      kept.push_back(k);
  if (kept.empty())
    throw InvalidParameter("no point has a usable normal; estimate and orient normals before (pcl_gpf_tool orient)");
  samples.points = SoaBuffer(kept.size());
  samples.normals = SoaBuffer(kept.size());
  const PointsView sorted = packed.index->sorted();
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t k = kept[i];
    samples.rows.push_back(packed.rows[k]);
    samples.points.x[i] = sorted.x[k];
    samples.points.y[i] = sorted.y[k];
    samples.points.z[i] = sorted.z[k];
    samples.normals.x[i] = packed.normals.x[k];
    samples.normals.y[i] = packed.normals.y[k];
    samples.normals.z[i] = packed.normals.z[k];
  }
  requireSurface(samples.points.view(), "points with a normal");
  result.points = kept.size();
  return samples;
}

double
measureInconsistency(const Samples& samples, unsigned threads)
{
  const PointIndex index(samples.points.view(), threads);
  SoaBuffer sorted(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    sorted.x[k] = samples.normals.x[index.order()[k]];
    sorted.y[k] = samples.normals.y[index.order()[k]];
    sorted.z[k] = samples.normals.z[index.order()[k]];
  }
  return inconsistentOrientation(index, sorted.view(), threads);
}

void
orientSamples(const MeshParameters& parameters, const std::array<double, 3>* viewpoint, const ProgressCallback& progress, Samples& samples,
              MeshResult& result)
{
  if (parameters.orientation == MeshOrientation::Keep)
    return;
  if (parameters.orientation == MeshOrientation::Auto) {
    result.inconsistent_normals = measureInconsistency(samples, parameters.number_of_threads);
    if (result.inconsistent_normals < kInconsistent)
      return;
  }
  NormalOrientationParameters orient = parameters.orient;
  orient.noise = samples.frame.lengthToLocal(orient.noise);
  orient.number_of_threads = parameters.number_of_threads;
  std::array<double, 3> eye{};
  for (std::size_t axis = 0; viewpoint && axis < 3; ++axis)
    eye[axis] = ((*viewpoint)[axis] - samples.frame.origin[axis]) / samples.frame.scale;
  result.orientation = orientNormals(orient, samples.points.view(), samples.normals.view(), viewpoint ? &eye : nullptr, progress);
  result.orientation.noise = samples.frame.lengthToWorld(result.orientation.noise);
  result.oriented = true;
}

/** Lengths as the core wants them. */
RimlsMeshParameters
toLocal(const MeshParameters& parameters, const LocalFrame& frame)
{
  RimlsMeshParameters rimls = parameters.rimls;
  rimls.cell_size = frame.lengthToLocal(rimls.cell_size);
  rimls.rimls.radius = frame.lengthToLocal(rimls.rimls.radius);
  rimls.rimls.minimum_radius = frame.lengthToLocal(rimls.rimls.minimum_radius);
  rimls.number_of_threads = parameters.number_of_threads;
  return rimls;
}

SurfaceMesh
makeMesh(const MeshParameters& parameters, const ProgressCallback& progress, const Samples& samples, MeshResult& result)
{
  if (parameters.method == MeshMethod::Poisson) {
    if (progress && !progress(0.0))
      throw Cancelled();
    SurfaceMesh mesh = meshPoisson(parameters.poisson, samples.points.view(), samples.normals.view(), parameters.number_of_threads);
    if (progress && !progress(1.0))
      throw Cancelled();
    return mesh;
  }
  const LocalFrame& frame = samples.frame;
  SurfaceMesh mesh = meshRimls(toLocal(parameters, frame), samples.points.view(), samples.normals.view(), progress, &result.rimls);
  for (double* length :
       {&result.rimls.cell_size, &result.rimls.spacing, &result.rimls.support_radius, &result.rimls.mean_vertex_movement})
    *length = frame.lengthToWorld(*length);
  return mesh;
}

void
unpackMesh(const Samples& samples, SurfaceMesh mesh, unsigned threads, MeshResult& result)
{
  result.source_rows = nearestOnSameSide(samples.points.view(), samples.normals.view(), mesh.vertices.view(), mesh.normals.view(), threads);
  for (std::uint32_t& source : result.source_rows)
    source = samples.rows[source];
  const MeshTopology topology = meshTopology(mesh);
  result.open_edges = topology.open_edges;
  result.components = topology.components;
  const AlignedArray<float>* position[3] = {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z};
  const AlignedArray<float>* normal[3] = {&mesh.normals.x, &mesh.normals.y, &mesh.normals.z};
  result.vertices.resize(3 * mesh.vertexCount());
  result.normals.resize(3 * mesh.vertexCount());
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.vertices[3 * v + axis] = samples.frame.toWorld((*position[axis])[v], axis);
      result.normals[3 * v + axis] = (*normal[axis])[v];
    }
  result.triangles = std::move(mesh.triangles);
}

} // namespace

void
checkMeshable(const DenoiseInput& input, const MeshParameters& parameters)
{
  validate(parameters.rimls);
  validate(parameters.poisson);
  const Packed packed = packPositions(input, false, parameters.number_of_threads);
  const PointsView points = packed.index->sorted();
  requireSurface(points, "finite points");
  if (parameters.method == MeshMethod::Rimls)
    checkMeshMemory(toLocal(parameters, packed.frame), points);
}

MeshResult
meshCloud(const DenoiseInput& input, const MeshParameters& parameters, const std::array<double, 3>* viewpoint, const StageProgress& progress)
{
  validate(parameters.rimls);
  validate(parameters.poisson);
  validate(parameters.orient);
  const auto stage = [&progress](const char* name) {
    return progress ? ProgressCallback([name, &progress](double fraction) { return progress(name, fraction); }) : ProgressCallback();
  };
  MeshResult result;
  Stopwatch watch;
  Samples samples = packSamples(input, parameters.number_of_threads, result);
  orientSamples(parameters, viewpoint, stage("orient"), samples, result);
  result.seconds_orient = watch.lap();
  unpackMesh(samples, makeMesh(parameters, stage("mesh"), samples, result), parameters.number_of_threads, result);
  result.seconds_mesh = watch.lap();
  return result;
}

} // namespace pcl_gpf
