// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/unpack.h>
#include <pcl_gpf/core/analysis/nearest_source.h>
#include <pcl_gpf/core/analysis/orientation_check.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/surface/marching_cubes_rimls.h>

#include <pcl/console/print.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace pcl_gpf {

template <typename PointT>
MarchingCubesRIMLS<PointT>::MarchingCubesRIMLS() : pcl::MarchingCubes<PointT>(0.0f, 0.0f)
{
  this->check_tree_ = false; // no search tree of PCL is needed
  setResolution(parameters_.resolution);
}

template <typename PointT>
MarchingCubesRIMLS<PointT>::~MarchingCubesRIMLS() = default;

template <typename PointT> void
MarchingCubesRIMLS<PointT>::setParameters(const RimlsMeshParameters& parameters)
{
  parameters_ = parameters;
  setResolution(parameters.resolution);
}

template <typename PointT> RimlsMeshParameters
MarchingCubesRIMLS<PointT>::getParameters() const
{
  RimlsMeshParameters parameters = parameters_;
  parameters.resolution = static_cast<unsigned>(std::max({0, this->res_x_, this->res_y_, this->res_z_}));
  return parameters;
}

template <typename PointT> void
MarchingCubesRIMLS<PointT>::reconstruct(pcl::PolygonMesh& output)
{
  if (this->input_) {
    pcl::MarchingCubes<PointT>::reconstruct(output);
    return;
  }
  PCL_ERROR("[pcl_gpf::%s::reconstruct] No input cloud is set.\n", getClassName().c_str());
  output = pcl::PolygonMesh();
}

template <typename PointT> void
MarchingCubesRIMLS<PointT>::reconstruct(PointCloud& points, std::vector<pcl::Vertices>& polygons)
{
  if (this->input_) {
    pcl::MarchingCubes<PointT>::reconstruct(points, polygons);
    return;
  }
  PCL_ERROR("[pcl_gpf::%s::reconstruct] No input cloud is set.\n", getClassName().c_str());
  points.clear();
  polygons.clear();
}

template <typename PointT> void
MarchingCubesRIMLS<PointT>::performReconstruction(pcl::PolygonMesh& output)
{
  PointCloud points;
  const auto header = output.header;
  output.cloud = pcl::PCLPointCloud2(); // PCL put the input here
  performReconstruction(points, output.polygons);
  points.header = header;
  pcl::toPCLPointCloud2(points, output.cloud);
}

template <typename PointT> void
MarchingCubesRIMLS<PointT>::performReconstruction(PointCloud& points, std::vector<pcl::Vertices>& polygons)
{
  const auto start = std::chrono::steady_clock::now();
  PointCloud vertices;
  if (&points != this->input_.get()) // the output may be the input
    points.clear();
  polygons.clear();
  corresponding_.clear();
  statistics_ = MarchingCubesRIMLSStatistics();
  try {
    validate(getParameters());
    if (this->iso_level_ != 0.0f)
      throw InvalidParameter("the iso level must be 0: the surface is where the signed distance is 0");
    const PackedCloud packed = pack(*this->input_, *this->indices_);
    statistics_.points = packed.size();
    statistics_.points_without_normal = packed.points_without_normal;
    statistics_.non_finite_points = packed.non_finite_points;
    if (packed.size() == 0 && packed.points_without_normal > 0)
      throw InvalidParameter("no point has a usable normal; fill the normals before, for example with pcl_gpf::estimateNormals(), "
                             "and orient them");
    if (packed.size() > 0)
      writeMesh(packed, makeMesh(packed), vertices, polygons);
    else
      PCL_WARN("[pcl_gpf::%s::reconstruct] None of the %zu points is finite; the mesh is empty.\n", getClassName().c_str(),
               packed.chosen.size());
    vertices.header = this->input_->header;
    points = std::move(vertices);
  }
  catch (const Cancelled&) {
    points.clear();
    statistics_.cancelled = true;
    PCL_WARN("[pcl_gpf::%s::reconstruct] Cancelled by the progress callback; the mesh is empty.\n", getClassName().c_str());
  }
  catch (...) {
    rethrowAsPclException(getClassName());
  }
  statistics_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename PointT> SurfaceMesh
MarchingCubesRIMLS<PointT>::makeMesh(const PackedCloud& packed)
{
  RimlsMeshParameters parameters = getParameters();
  const LocalFrame& frame = packed.frame;
  parameters.cell_size = frame.lengthToLocal(parameters.cell_size);
  parameters.rimls.radius = frame.lengthToLocal(parameters.rimls.radius);
  parameters.rimls.minimum_radius = frame.lengthToLocal(parameters.rimls.minimum_radius);
  if (check_orientation_)
    requireConsistentOrientation(packed.points.view(), packed.normals.view(), parameters.number_of_threads);
  RimlsMeshStatistics& done = statistics_.mesh;
  SurfaceMesh mesh = meshRimls(parameters, packed.points.view(), packed.normals.view(), progress_, &done);
  for (double* length : {&done.cell_size, &done.spacing, &done.support_radius, &done.mean_vertex_movement})
    *length = frame.lengthToWorld(*length);
  return mesh;
}

template <typename PointT> void
MarchingCubesRIMLS<PointT>::writeMesh(const PackedCloud& packed, const SurfaceMesh& mesh, PointCloud& points,
                                      std::vector<pcl::Vertices>& polygons)
{
  std::vector<pcl::index_t> usable;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] == PointState::Usable)
      usable.push_back(packed.chosen[i]);
  const std::vector<std::uint32_t> sources = nearestOnSameSide(packed.points.view(), packed.normals.view(), mesh.vertices.view(),
                                                               mesh.normals.view(), parameters_.number_of_threads);
  points.resize(mesh.vertexCount());
  points.is_dense = true;
  points.sensor_origin_ = this->input_->sensor_origin_;
  points.sensor_orientation_ = this->input_->sensor_orientation_;
  corresponding_.reserve(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    corresponding_.push_back(usable[sources[v]]);
    PointT& point = points[v];
    point = (*this->input_)[static_cast<std::size_t>(corresponding_.back())];
    point.x = detail::finiteFloat(packed.frame.toWorld(mesh.vertices.x[v], 0));
    point.y = detail::finiteFloat(packed.frame.toWorld(mesh.vertices.y[v], 1));
    point.z = detail::finiteFloat(packed.frame.toWorld(mesh.vertices.z[v], 2));
    point.normal_x = mesh.normals.x[v];
    point.normal_y = mesh.normals.y[v];
    point.normal_z = mesh.normals.z[v];
  }
  polygons.resize(mesh.triangleCount());
  for (std::size_t t = 0; t < polygons.size(); ++t) {
    polygons[t].vertices.resize(3);
    for (std::size_t k = 0; k < 3; ++k)
      polygons[t].vertices[k] = static_cast<pcl::index_t>(mesh.triangles[3 * t + k]);
  }
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_MarchingCubesRIMLS(T) template class PCL_GPF_EXPORT pcl_gpf::MarchingCubesRIMLS<T>;
