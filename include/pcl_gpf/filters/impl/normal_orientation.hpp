// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/filters/normal_orientation.h>

#include <cmath>

namespace pcl_gpf {

template <typename PointT>
NormalOrientation<PointT>::NormalOrientation(bool extract_removed_indices)
: OperatorFilter<PointT>("NormalOrientation", extract_removed_indices)
{}

template <typename PointT>
NormalOrientation<PointT>::~NormalOrientation() = default;

template <typename PointT> void
NormalOrientation<PointT>::setParameters(const NormalOrientationParameters& parameters)
{
  parameters_ = parameters;
  this->setNumberOfThreads(parameters.number_of_threads);
}

template <typename PointT> NormalOrientationParameters
NormalOrientation<PointT>::getParameters() const
{
  NormalOrientationParameters parameters = parameters_;
  parameters.number_of_threads = this->getNumberOfThreads();
  return parameters;
}

template <typename PointT> FilterStatistics&
NormalOrientation<PointT>::clearStatistics()
{
  statistics_ = NormalOrientationFilterStatistics();
  return statistics_;
}

template <typename PointT> std::array<double, 3>
NormalOrientation<PointT>::worldViewPoint() const
{
  if (view_point_source_ == ViewPointSource::Given)
    return view_point_;
  const auto& origin = this->input_->sensor_origin_;
  return {origin[0], origin[1], origin[2]};
}

template <typename PointT> void
NormalOrientation<PointT>::checkParameters() const
{
  validate(getParameters());
  if (!hasViewPoint())
    return;
  for (const double coordinate : worldViewPoint())
    if (!std::isfinite(coordinate))
      throw InvalidParameter("the view point is not finite");
}

template <typename PointT> void
NormalOrientation<PointT>::runOperator(const OperatorInput& input, MutableVectorsView, MutableVectorsView normals)
{
  const LocalFrame& frame = input.cloud.frame;
  NormalOrientationParameters parameters = getParameters();
  parameters.noise = frame.lengthToLocal(parameters.noise);
  std::array<double, 3> view_point = worldViewPoint();
  for (std::size_t axis = 0; axis < 3; ++axis)
    view_point[axis] = (view_point[axis] - frame.origin[axis]) / frame.scale;
  statistics_.orientation = orientNormals(parameters,
                                          input.cloud.points.view(),
                                          normals,
                                          hasViewPoint() ? &view_point : nullptr,
                                          this->getProgressCallback());
  statistics_.orientation.noise = frame.lengthToWorld(statistics_.orientation.noise);
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_NormalOrientation(T) template class PCL_GPF_EXPORT pcl_gpf::NormalOrientation<T>;
