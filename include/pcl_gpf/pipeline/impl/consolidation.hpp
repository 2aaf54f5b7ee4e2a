// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/unpack.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/consolidation.h>
#include <pcl_gpf/pipeline/impl/chosen_columns.hpp>

#include <pcl/console/print.h>
#include <pcl/conversions.h>

#include <array>
#include <utility>

namespace pcl_gpf {

template <typename PointT> void
Consolidation<PointT>::process(PointCloud& output)
{
  runInto(output, nullptr);
}

template <typename PointT> void
Consolidation<PointT>::process(PointCloud& output, pcl::PolygonMesh& mesh)
{
  mesh = pcl::PolygonMesh();
  runInto(output, &mesh);
}

template <typename PointT> void
Consolidation<PointT>::performProcessing(PointCloud& output)
{
  runStages(output, nullptr);
}

template <typename PointT> void
Consolidation<PointT>::runInto(PointCloud& output, pcl::PolygonMesh* mesh)
{
  statistics_ = ConsolidationStatistics();
  corresponding_.clear();
  mesh_corresponding_.clear();
  PointCloud made; // the output may be the input
  const auto giveUp = [&] {
    this->deinitCompute();
    corresponding_.clear();
    mesh_corresponding_.clear();
    if (&output != this->input_.get())
      output = PointCloud();
    if (mesh)
      *mesh = pcl::PolygonMesh();
  };
  try {
    if (this->initCompute()) { // prints PCL's message when there is no input
      made.header = this->input_->header;
      made.sensor_origin_ = this->input_->sensor_origin_;
      made.sensor_orientation_ = this->input_->sensor_orientation_;
      runStages(made, mesh);
      this->deinitCompute();
    }
    output = std::move(made);
  }
  catch (const Cancelled&) {
    giveUp();
    statistics_.cancelled = true;
    PCL_WARN("[pcl_gpf::Consolidation::process] Cancelled by the progress callback; the output is empty.\n");
  }
  catch (...) {
    giveUp();
    rethrowAsPclException("Consolidation");
  }
}

template <typename PointT> void
Consolidation<PointT>::runStages(PointCloud& output, pcl::PolygonMesh* mesh)
{
  const ConsolidationParameters parameters = effectiveParameters(mesh != nullptr);
  validate(parameters);
  BoundingBox box;
  PackedCloud choice = detail::chooseAndBox(*this->input_, *this->indices_, box);
  statistics_.input_points = choice.chosen.size() - choice.non_finite_points;
  if (statistics_.input_points == 0) {
    PCL_WARN("[pcl_gpf::Consolidation::process] None of the %zu points is finite; the output is empty.\n", choice.chosen.size());
    return;
  }
  const detail::ChosenColumns columns(*this->input_, choice);
  ConsolidationResult result = consolidate(columns.view(), parameters, progress_);
  writeCloud(choice.chosen, parameters.upsample ? result.upsampled : result.points, output);
  if (mesh)
    writeMesh(choice.chosen, result.mesh, *mesh);
  result.points = result.upsampled = ConsolidatedCloud();
  result.mesh.vertices = {};
  result.mesh.normals = {};
  result.mesh.triangles = {};
  result.mesh.source_rows = {};
  statistics_.chain = std::move(result);
}

template <typename PointT> ConsolidationParameters
Consolidation<PointT>::effectiveParameters(bool with_mesh) const
{
  ConsolidationParameters parameters = parameters_;
  parameters.mesh = parameters.mesh && with_mesh;
  const Eigen::Vector3f origin = this->input_->sensor_origin_.template head<3>();
  if (!parameters.viewpoint && use_sensor_origin_ && origin != Eigen::Vector3f::Zero())
    parameters.viewpoint = std::array<double, 3>{static_cast<double>(origin[0]), static_cast<double>(origin[1]), static_cast<double>(origin[2])};
  return parameters;
}

template <typename PointT> void
Consolidation<PointT>::copyParents(const pcl::Indices& chosen, const std::vector<std::uint32_t>& rows, PointCloud& points, pcl::Indices& from) const
{
  from.reserve(rows.size());
  points.reserve(rows.size());
  for (const std::uint32_t row : rows) {
    from.push_back(chosen[row]);
    points.push_back((*this->input_)[static_cast<std::size_t>(from.back())]);
  }
}

template <typename PointT> void
Consolidation<PointT>::writeCloud(const pcl::Indices& chosen, const ConsolidatedCloud& cloud, PointCloud& output)
{
  copyParents(chosen, cloud.source_rows, output, corresponding_);
  output.is_dense = true;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    PointT& point = output[i];
    point.x = detail::finiteFloat(cloud.x[i]);
    point.y = detail::finiteFloat(cloud.y[i]);
    point.z = detail::finiteFloat(cloud.z[i]);
    point.normal_x = cloud.normal_x[i];
    point.normal_y = cloud.normal_y[i];
    point.normal_z = cloud.normal_z[i];
    output.is_dense = output.is_dense && pcl::isXYZFinite(point) && pcl::isNormalFinite(point);
  }
}

template <typename PointT> void
Consolidation<PointT>::writeMesh(const pcl::Indices& chosen, const MeshResult& made, pcl::PolygonMesh& mesh)
{
  PointCloud vertices;
  copyParents(chosen, made.source_rows, vertices, mesh_corresponding_);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    PointT& point = vertices[v];
    point.x = detail::finiteFloat(made.vertices[3 * v]);
    point.y = detail::finiteFloat(made.vertices[3 * v + 1]);
    point.z = detail::finiteFloat(made.vertices[3 * v + 2]);
    point.normal_x = made.normals[3 * v];
    point.normal_y = made.normals[3 * v + 1];
    point.normal_z = made.normals[3 * v + 2];
  }
  vertices.header = this->input_->header;
  mesh.header = this->input_->header;
  pcl::toPCLPointCloud2(vertices, mesh.cloud);
  mesh.polygons.resize(made.triangles.size() / 3);
  for (std::size_t t = 0; t < mesh.polygons.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      mesh.polygons[t].vertices.push_back(static_cast<pcl::index_t>(made.triangles[3 * t + k]));
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_Consolidation(T) template class PCL_GPF_EXPORT pcl_gpf::Consolidation<T>;
