// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/orientation_check.h>
#include <pcl_gpf/filters/rimls_projection.h>

#include <algorithm>
#include <vector>

namespace pcl_gpf {

template <typename PointT>
RIMLSProjection<PointT>::RIMLSProjection(bool extract_removed_indices)
: ProjectionFilter<PointT>("RIMLSProjection", extract_removed_indices)
{}

template <typename PointT>
RIMLSProjection<PointT>::~RIMLSProjection() = default;

template <typename PointT> void
RIMLSProjection<PointT>::setParameters(const RimlsParameters& parameters)
{
  parameters_ = parameters;
  this->setNumberOfThreads(parameters.number_of_threads);
}

template <typename PointT> RimlsParameters
RIMLSProjection<PointT>::getParameters() const
{
  RimlsParameters parameters = parameters_;
  parameters.number_of_threads = this->getNumberOfThreads();
  return parameters;
}

template <typename PointT> FilterStatistics&
RIMLSProjection<PointT>::clearStatistics()
{
  statistics_ = RIMLSProjectionStatistics();
  return statistics_;
}

template <typename PointT> void
RIMLSProjection<PointT>::checkParameters() const
{
  validate(getParameters());
}

template <typename PointT> void
RIMLSProjection<PointT>::runOperator(const OperatorInput& input, MutableVectorsView displacements, MutableVectorsView normals)
{
  const PackedCloud& cloud = input.cloud;
  RimlsParameters parameters = getParameters();
  parameters.radius = cloud.frame.lengthToLocal(parameters.radius);
  parameters.minimum_radius = cloud.frame.lengthToLocal(parameters.minimum_radius);
  if (check_orientation_)
    requireConsistentOrientation(cloud.points.view(), cloud.normals.view(), parameters.number_of_threads);
  const RimlsSurface surface(parameters, cloud.points.view(), cloud.normals.view());

  SoaBuffer moved(input.rows.size());
  for (std::size_t i = 0; i < input.rows.size(); ++i) {
    moved.x[i] = cloud.points.x[input.rows[i]];
    moved.y[i] = cloud.points.y[input.rows[i]];
    moved.z[i] = cloud.points.z[input.rows[i]];
  }
  RimlsProjectionStatistics& done = statistics_.projection;
  done = surface.project(moved.view(), normals, nullptr, input.search, this->getProgressCallback());
  for (std::size_t i = 0; i < input.rows.size(); ++i) {
    displacements.x[i] = moved.x[i] - cloud.points.x[input.rows[i]];
    displacements.y[i] = moved.y[i] - cloud.points.y[input.rows[i]];
    displacements.z[i] = moved.z[i] - cloud.points.z[input.rows[i]];
  }

  done.mean_movement = cloud.frame.lengthToWorld(done.mean_movement);
  done.max_movement = cloud.frame.lengthToWorld(done.max_movement);
  std::vector<float> radii = surface.supportRadii();
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  statistics_.support_radius = cloud.frame.lengthToWorld(radii[radii.size() / 2]);
  statistics_.spacing = cloud.frame.lengthToWorld(surface.spacing());
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_RIMLSProjection(T) template class PCL_GPF_EXPORT pcl_gpf::RIMLSProjection<T>;
