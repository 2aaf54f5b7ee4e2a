// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/surface/poisson_mesh.h>

#include <pcl/point_types.h>
#include <pcl/surface/poisson.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr std::size_t kFewestPoints = 4;

void
require(bool inside, const char* name, const char* range)
{
  if (!inside)
    throw InvalidParameter(std::string("poisson ") + name + " is out of range; range: " + range);
}

void
reconstruct(const PoissonMeshParameters& p, PointsView points, NormalsView normals,
            pcl::PointCloud<pcl::PointNormal>& vertices, std::vector<pcl::Vertices>& polygons)
{
  const pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  cloud->resize(points.size);
  for (std::size_t i = 0; i < points.size; ++i) {
    pcl::PointNormal& point = (*cloud)[i];
    point.x = points.x[i];
    point.y = points.y[i];
    point.z = points.z[i];
    point.normal_x = normals.x[i];
    point.normal_y = normals.y[i];
    point.normal_z = normals.z[i];
  }
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setDepth(static_cast<int>(p.depth));
  poisson.setMinDepth(static_cast<int>(p.depth < 5 ? p.depth : 5));
  poisson.setSolverDivide(static_cast<int>(p.depth < 8 ? p.depth : 8));
  poisson.setIsoDivide(static_cast<int>(p.depth < 8 ? p.depth : 8));
  poisson.setPointWeight(static_cast<float>(p.point_weight));
  poisson.setSamplesPerNode(static_cast<float>(p.samples_per_node));
  poisson.setThreads(1); // repeatable
  poisson.setInputCloud(cloud);
  poisson.reconstruct(vertices, polygons);
}

/** Turns all faces if most of them look against the normal of the nearest point. */
void
orientFaces(SurfaceMesh& mesh, const PointIndex& index, NormalsView normals)
{
  mesh.normals = SoaBuffer(mesh.vertexCount());
  completeNormals(mesh);
  double along = 0.0;
  std::vector<float> distances_sq;
  std::vector<std::uint32_t> found;
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertexCount() / 4096);
  for (std::size_t i = 0; i < mesh.vertexCount(); i += stride) {
    index.tree().nearest(index.sorted(), {mesh.vertices.x[i], mesh.vertices.y[i], mesh.vertices.z[i]}, 1, distances_sq,
                         &found);
    if (found.empty())
      continue;
    const std::uint32_t source = index.order()[found.front()];
    along += mesh.normals.x[i] * normals.x[source] + mesh.normals.y[i] * normals.y[source] +
             mesh.normals.z[i] * normals.z[source];
  }
  if (along >= 0.0)
    return;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
  for (AlignedArray<float>* axis : {&mesh.normals.x, &mesh.normals.y, &mesh.normals.z})
    for (float& component : *axis)
      component = -component;
}

} // namespace

void
validate(const PoissonMeshParameters& p)
{
  require(p.depth >= 2 && p.depth <= 12, "depth", "2 .. 12");
  require(p.point_weight >= 0.0 && p.point_weight <= 1000.0, "point_weight", "0 .. 1000");
  require(p.samples_per_node >= 1.0 && p.samples_per_node <= 20.0, "samples_per_node", "1 .. 20");
  require(p.trim >= 0.0 && std::isfinite(p.trim), "trim", ">= 0");
  require(p.smallest_component >= 0.0 && p.smallest_component <= 1.0, "smallest_component", "0 .. 1");
}

SurfaceMesh
meshPoisson(const PoissonMeshParameters& parameters, PointsView points, NormalsView normals, unsigned number_of_threads)
{
  validate(parameters);
  const PointIndex index(points, number_of_threads);
  const double spacing = estimateSpacing(index, number_of_threads);
  if (points.size < kFewestPoints || !(spacing > 0.0))
    throw UnsuitableData(std::to_string(points.size) + " points" +
                         (points.size < kFewestPoints ? "" : " in one place") + " make no surface");
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  reconstruct(parameters, points, normals, vertices, polygons);

  SurfaceMesh mesh;
  mesh.vertices = SoaBuffer(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    mesh.vertices.x[i] = vertices[i].x;
    mesh.vertices.y[i] = vertices[i].y;
    mesh.vertices.z[i] = vertices[i].z;
  }
  for (const pcl::Vertices& polygon : polygons)
    for (std::size_t k = 2; k < polygon.vertices.size(); ++k)
      for (const std::size_t corner : {std::size_t{0}, k - 1, k})
        mesh.triangles.push_back(static_cast<std::uint32_t>(polygon.vertices[corner]));
  trimMesh(mesh, index, parameters.trim > 0.0 ? parameters.trim * spacing : std::numeric_limits<double>::infinity(),
           number_of_threads);
  removeSmallComponents(mesh, parameters.smallest_component);
  orientFaces(mesh, index, normals);
  return mesh;
}

} // namespace pcl_gpf
