// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/unpack.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/surface/edge_aware_upsampling.h>

#include <pcl/console/print.h>

#include <chrono>
#include <utility>

namespace pcl_gpf {

template <typename PointT> void
EdgeAwareUpsampling<PointT>::process(PointCloud& output)
{
  const auto start = std::chrono::steady_clock::now();
  statistics_ = EdgeAwareUpsamplingStatistics();
  corresponding_.clear();
  PointCloud made; // the output may be the input
  try {
    if (this->initCompute()) { // prints PCL's message when there is no input
      made.header = this->input_->header;
      made.sensor_origin_ = this->input_->sensor_origin_;
      made.sensor_orientation_ = this->input_->sensor_orientation_;
      performProcessing(made);
      this->deinitCompute();
    }
  }
  catch (const Cancelled&) {
    this->deinitCompute();
    made.clear();
    corresponding_.clear();
    statistics_.cancelled = true;
    PCL_WARN("[pcl_gpf::EdgeAwareUpsampling::process] Cancelled by the progress callback; the output is empty.\n");
  }
  catch (...) {
    this->deinitCompute();
    corresponding_.clear();
    if (&output != this->input_.get())
      output.clear();
    rethrowAsPclException("EdgeAwareUpsampling");
  }
  output = std::move(made);
  statistics_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename PointT> void
EdgeAwareUpsampling<PointT>::performProcessing(PointCloud& output)
{
  validate(parameters_);
  const PackedCloud packed = pack(*this->input_, *this->indices_);
  statistics_.input_points = packed.size();
  statistics_.points_without_normal = packed.points_without_normal;
  statistics_.non_finite_points = packed.non_finite_points;
  if (packed.size() == 0 && packed.points_without_normal == 0) {
    PCL_WARN("[pcl_gpf::EdgeAwareUpsampling::process] None of the %zu points is finite; there is nothing to fill.\n",
             packed.chosen.size());
    return;
  }
  if (packed.size() == 0)
    throw InvalidParameter("no point has a usable normal; fill the normals before, "
                           "for example with pcl_gpf::estimateNormals() and pcl_gpf::BilateralNormalFilter");
  if (packed.points_without_normal > 0)
    PCL_WARN("[pcl_gpf::EdgeAwareUpsampling::process] %zu of %zu points have no usable normal; nothing is inserted beside them.\n",
             packed.points_without_normal,
             packed.chosen.size());
  const EdgeAwareUpsamplingResult result =
      upsampleEdgeAware(localParameters(packed), packed.points.view(), packed.normals.view(), progress_);
  statistics_.inserted_points = result.parents.size();
  statistics_.radius = packed.frame.lengthToWorld(result.radius);
  statistics_.rounds = result.rounds;
  statistics_.target_reached = result.target_reached;
  writeInput(packed, output);
  writeInserted(packed, result, output);
}

template <typename PointT> EdgeAwareUpsamplingParameters
EdgeAwareUpsampling<PointT>::localParameters(const PackedCloud& packed) const
{
  EdgeAwareUpsamplingParameters local = parameters_;
  local.radius = packed.frame.lengthToLocal(parameters_.radius);
  local.spacing = packed.frame.lengthToLocal(parameters_.spacing);
  return local;
}

template <typename PointT> void
EdgeAwareUpsampling<PointT>::writeInput(const PackedCloud& packed, PointCloud& output)
{
  const std::size_t finite = packed.chosen.size() - packed.non_finite_points;
  output.reserve(finite + statistics_.inserted_points);
  corresponding_.reserve(finite + statistics_.inserted_points);
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] != PointState::NonFinite) {
      output.push_back((*this->input_)[static_cast<std::size_t>(packed.chosen[i])]);
      corresponding_.push_back(packed.chosen[i]);
    }
  output.is_dense = packed.points_without_normal == 0;
}

template <typename PointT> void
EdgeAwareUpsampling<PointT>::writeInserted(const PackedCloud& packed, const EdgeAwareUpsamplingResult& result,
                                           PointCloud& output)
{
  std::vector<pcl::index_t> usable; // the cloud index of each packed row
  usable.reserve(packed.size());
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] == PointState::Usable)
      usable.push_back(packed.chosen[i]);
  for (std::size_t k = 0; k < result.parents.size(); ++k) {
    const std::size_t row = result.parents[k];
    PointT point = (*this->input_)[static_cast<std::size_t>(usable[row])];
    // From the parent's own coordinates, which far from the origin are finer than the frame's.
    point.x = detail::moved(point.x, result.points.x[k] - packed.points.x[row], packed.frame.scale);
    point.y = detail::moved(point.y, result.points.y[k] - packed.points.y[row], packed.frame.scale);
    point.z = detail::moved(point.z, result.points.z[k] - packed.points.z[row], packed.frame.scale);
    point.normal_x = result.normals.x[k];
    point.normal_y = result.normals.y[k];
    point.normal_z = result.normals.z[k];
    output.push_back(point);
    corresponding_.push_back(usable[row]);
  }
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_EdgeAwareUpsampling(T) template class PCL_GPF_EXPORT pcl_gpf::EdgeAwareUpsampling<T>;
