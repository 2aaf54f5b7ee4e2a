// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/operators/gpf.h>
#include <pcl_gpf/filters/gpf.h>

namespace pcl_gpf {

template <typename PointT>
GPF<PointT>::GPF(bool extract_removed_indices) : ProjectionFilter<PointT>("GPF", extract_removed_indices)
{}

template <typename PointT>
GPF<PointT>::~GPF() = default;

template <typename PointT> void
GPF<PointT>::setParameters(const GPFParameters& parameters)
{
  parameters_ = parameters;
  this->setSampleRatio(parameters.sample_ratio);
  this->setSeed(parameters.seed);
  this->setNumberOfThreads(parameters.number_of_threads);
}

template <typename PointT> GPFParameters
GPF<PointT>::getParameters() const
{
  GPFParameters parameters = parameters_;
  parameters.sample_ratio = this->getSampleRatio();
  parameters.seed = this->getSeed();
  parameters.number_of_threads = this->getNumberOfThreads();
  return parameters;
}

template <typename PointT> FilterStatistics&
GPF<PointT>::clearStatistics()
{
  statistics_ = GPFStatistics();
  return statistics_;
}

template <typename PointT> void
GPF<PointT>::checkParameters() const
{
  validate(getParameters());
}

template <typename PointT> GPFParameters
GPF<PointT>::effectiveParameters(const PackedCloud& cloud)
{
  GPFParameters parameters = getParameters();
  parameters.support_radius = cloud.frame.lengthToLocal(parameters.support_radius);
  statistics_.support_radius_estimated = parameters.support_radius == 0;
  if (statistics_.support_radius_estimated) {
    PlaneNormalsParameters normals;
    BilateralNormalsParameters bilateral;
    estimateParameters(measureScale(cloud.points.view(), parameters.number_of_threads), normals, bilateral, parameters);
  }
  statistics_.support_radius = cloud.frame.lengthToWorld(parameters.support_radius);
  return parameters;
}

template <typename PointT> void
GPF<PointT>::runOperator(const OperatorInput& input, MutableVectorsView displacements, MutableVectorsView normals)
{
  const GPFParameters parameters = effectiveParameters(input.cloud);
  SoaBuffer remainders;
  if (runsInDouble(parameters))
    remainders = packRemainders(*this->input_, input.cloud);
  GPFInput data;
  data.points = input.cloud.points.view();
  data.remainders = remainders.view();
  data.normals = input.cloud.normals.view();
  data.samples = input.every_row ? nullptr : input.rows.data();
  data.sample_count = input.every_row ? 0 : input.rows.size();
  data.search = input.search;

  GPFState state = gpfInit(parameters, data);
  const ProgressCallback progress = this->getProgressCallback();
  const double all = 1.0 * parameters.maximum_iterations + parameters.gap_iterations;
  const double share = all > 0.0 ? parameters.maximum_iterations / all : 1.0;
  statistics_.iterations = gpfRun(state, partOf(progress, 0.0, share));
  statistics_.gap_iterations = gpfFillGaps(state, partOf(progress, share, 1.0));
  state.displacements(displacements);
  state.normals(normals);

  for (std::vector<IterationStats>* rounds : {&statistics_.iterations, &statistics_.gap_iterations})
    for (IterationStats& iteration : *rounds) {
      iteration.mean_movement = input.cloud.frame.lengthToWorld(iteration.mean_movement);
      iteration.max_movement = input.cloud.frame.lengthToWorld(iteration.max_movement);
    }
  if (!statistics_.iterations.empty())
    statistics_.isolated_points = statistics_.iterations.back().isolated_points;
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_GPF(T) template class PCL_GPF_EXPORT pcl_gpf::GPF<T>;
