// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/surface/mls_upsampling.h>

#include <pcl/common/copy_point.h>
#include <pcl/console/print.h>

#include <chrono>
#include <string>
#include <utility>

namespace pcl_gpf {

namespace detail {

/** \brief The finite points of the indices about the centre of their box, so that large coordinates cost no digits. */
template <typename PointT> pcl::PointCloud<pcl::PointXYZ>::Ptr
finitePoints(const pcl::PointCloud<PointT>& cloud, const PackedCloud& packed, pcl::Indices& from, std::array<double, 3>& centre)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr points(new pcl::PointCloud<pcl::PointXYZ>);
  BoundingBox box;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] != PointState::NonFinite) {
      from.push_back(packed.chosen[i]);
      const PointT& p = cloud[static_cast<std::size_t>(packed.chosen[i])];
      box.add(p.x, p.y, p.z);
    }
  centre = localFrame(box).origin;
  for (const pcl::index_t index : from) {
    const PointT& p = cloud[static_cast<std::size_t>(index)];
    points->push_back(pcl::PointXYZ(static_cast<float>(p.x - centre[0]), static_cast<float>(p.y - centre[1]),
                                    static_cast<float>(p.z - centre[2])));
  }
  return points;
}

/** \brief Turns `normal` to the side of the point's own normal, or else towards the viewpoint. */
template <typename PointT> void
orientLike(const PointT& point, const Eigen::Vector3f& viewpoint, pcl::PointNormal& made)
{
  const bool has_normal = pointState(point) == PointState::Usable;
  const Eigen::Vector3f side = has_normal ? Eigen::Vector3f(point.normal_x, point.normal_y, point.normal_z)
                                          : Eigen::Vector3f(viewpoint - point.getVector3fMap());
  if (made.getNormalVector3fMap().dot(side) < 0.0f)
    made.getNormalVector3fMap() *= -1.0f;
}

} // namespace detail

template <typename PointT> void
MLSUpsampling<PointT>::process(PointCloud& output)
{
  const auto start = std::chrono::steady_clock::now();
  statistics_ = MLSUpsamplingStatistics();
  corresponding_.clear();
  dropped_.clear();
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
  catch (...) {
    this->deinitCompute();
    if (&output != this->input_.get())
      output.clear();
    rethrowAsPclException("MLSUpsampling");
  }
  output = std::move(made);
  statistics_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename PointT> void
MLSUpsampling<PointT>::performProcessing(PointCloud& output)
{
  validate(parameters_);
  const PackedCloud packed = pack(*this->input_, *this->indices_);
  pcl::Indices from;
  std::array<double, 3> centre{};
  const pcl::PointCloud<pcl::PointXYZ>::Ptr points = detail::finitePoints(*this->input_, packed, from, centre);
  statistics_.input_points = from.size();
  statistics_.non_finite_points = packed.non_finite_points;
  if (from.empty()) {
    PCL_WARN("[pcl_gpf::MLSUpsampling::process] None of the %zu points is finite; there is nothing to fit.\n", packed.chosen.size());
    return;
  }
  const MLSPoints made = upsampleByMls(points, parameters_);
  statistics_.radius = made.radius;
  statistics_.output_points = made.points.size();
  for (const std::uint32_t k : made.dropped)
    dropped_.push_back(from[k]);
  std::sort(dropped_.begin(), dropped_.end());
  if (!dropped_.empty())
    PCL_WARN("[pcl_gpf::MLSUpsampling::process] %zu of %zu points have fewer than 3 neighbours within the radius and are left "
             "out; see getDroppedIndices().\n",
             dropped_.size(),
             from.size());
  const Eigen::Vector3f viewpoint = this->input_->sensor_origin_.template head<3>();
  output.reserve(made.points.size());
  corresponding_.reserve(made.points.size());
  output.is_dense = true;
  for (std::size_t k = 0; k < made.points.size(); ++k) {
    PointT point = (*this->input_)[static_cast<std::size_t>(from[made.sources[k]])];
    pcl::PointNormal surface = made.points[k];
    detail::orientLike(point, viewpoint, surface);
    surface.x = static_cast<float>(surface.x + centre[0]);
    surface.y = static_cast<float>(surface.y + centre[1]);
    surface.z = static_cast<float>(surface.z + centre[2]);
    pcl::copyPoint(surface, point); // fields that only the input has stay
    output.is_dense = output.is_dense && pcl::isXYZFinite(point) && pcl::isNormalFinite(point);
    output.push_back(point);
    corresponding_.push_back(from[made.sources[k]]);
  }
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_MLSUpsampling(T) template class PCL_GPF_EXPORT pcl_gpf::MLSUpsampling<T>;
