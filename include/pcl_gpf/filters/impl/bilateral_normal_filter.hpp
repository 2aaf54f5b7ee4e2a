// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/filters/bilateral_normal_filter.h>

namespace pcl_gpf {

template <typename PointT>
BilateralNormalFilter<PointT>::BilateralNormalFilter(bool extract_removed_indices)
: OperatorFilter<PointT>("BilateralNormalFilter", extract_removed_indices)
{}

template <typename PointT>
BilateralNormalFilter<PointT>::~BilateralNormalFilter() = default;

template <typename PointT> void
BilateralNormalFilter<PointT>::setParameters(const BilateralNormalsParameters& parameters)
{
  parameters_ = parameters;
  this->setNumberOfThreads(parameters.number_of_threads);
}

template <typename PointT> BilateralNormalsParameters
BilateralNormalFilter<PointT>::getParameters() const
{
  BilateralNormalsParameters parameters = parameters_;
  parameters.number_of_threads = this->getNumberOfThreads();
  return parameters;
}

template <typename PointT> FilterStatistics&
BilateralNormalFilter<PointT>::clearStatistics()
{
  statistics_ = BilateralNormalFilterStatistics();
  return statistics_;
}

template <typename PointT> void
BilateralNormalFilter<PointT>::checkParameters() const
{
  validate(getParameters());
}

template <typename PointT> BilateralNormalsParameters
BilateralNormalFilter<PointT>::effectiveParameters(const PackedCloud& cloud)
{
  BilateralNormalsParameters parameters = getParameters();
  parameters.radius = cloud.frame.lengthToLocal(parameters.radius);
  statistics_.radius_estimated = parameters.radius == 0 && parameters.neighbors == 0;
  if (statistics_.radius_estimated) {
    PlaneNormalsParameters normals;
    GPFParameters gpf;
    estimateParameters(measureScale(cloud.points.view(), parameters.number_of_threads), normals, parameters, gpf);
  }
  statistics_.radius = cloud.frame.lengthToWorld(parameters.radius);
  return parameters;
}

template <typename PointT> void
BilateralNormalFilter<PointT>::runOperator(const OperatorInput& input, MutableVectorsView, MutableVectorsView normals)
{
  statistics_.normals = filterNormalsBilaterally(effectiveParameters(input.cloud),
                                                 input.cloud.points.view(),
                                                 normals,
                                                 input.search,
                                                 this->getProgressCallback());
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_BilateralNormalFilter(T) template class PCL_GPF_EXPORT pcl_gpf::BilateralNormalFilter<T>;
