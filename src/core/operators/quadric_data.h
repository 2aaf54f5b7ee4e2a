// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/quadric_fit.h>
#include <pcl_gpf/core/point_index.h>

#include "../merged_points.h"
#include "../sorted_points.h"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_gpf {

class QuadricData;

/** \brief A place and the frame of its normal. */
struct QueryFrame {
  Eigen::Vector3d origin, u, v, n;
};

/** \brief Frames about sorted places, as kernels take them. */
class QueryFrames {
public:
  explicit QueryFrames(std::size_t count) : origin(count, kFarAway), u(count), v(count), n(count) {}
  QueryFrames(const QuadricData& data, const std::vector<std::uint32_t>& places);

  std::size_t size() const { return origin.size(); }
  QueryFrame of(std::size_t q) const;

  SortedVectors<float> origin, u, v, n;
};

/** \brief Normal equations of all queries: tasks of kQueries each, whose rows are kQueries long. */
class QuadricSums {
public:
  static constexpr std::size_t kQueries = kBlocksPerTask * kQueryBlock;

  explicit QuadricSums(std::size_t queries);
  const float* of(std::size_t q) const { return sums_.data() + q / kQueries * kQueries * kernels::QuadricMoments::kSums + q % kQueries; }
  static constexpr std::size_t row() { return kQueries; } ///< from one sum of a query to the next
  float* task(std::size_t first_query) { return sums_.data() + first_query * kernels::QuadricMoments::kSums; }

private:
  AlignedArray<float> sums_;
};

/** \brief A filtered cloud, and means of it with those of the noisy heights. */
class QuadricData {
public:
  QuadricData(const QuadricFitParameters& p, PointsView noisy, VectorsView positions, VectorsView normals, std::size_t threads);

  const PointIndex& points() const { return points_; }
  Eigen::Vector3d position(std::size_t k) const { return {points_.sorted().x[k], points_.sorted().y[k], points_.sorted().z[k]}; }
  Eigen::Vector3d normal(std::size_t k) const { return {normals_.x[k], normals_.y[k], normals_.z[k]}; }

  /** \brief Makes the means for balls of this radius. \return false where balls hold too few points for means */
  bool
  average(double radius);

  /** \brief Sums over those means. */
  QuadricSums
  sums(const QueryFrames& queries, double radius) const;

private:
  void averageHeights();
  void averageScatter(double radius);

  const QuadricFitParameters& p_;
  std::size_t threads_;
  PointIndex points_;
  SortedVectors<float> normals_;
  AlignedArray<float> heights_;  ///< of the noisy points above the filtered ones, outliers cut
  MergedPoints means_;
  SortedVectors<float> noisy_;   ///< means raised by their mean height
  AlignedArray<float> mean_height_;
  AlignedArray<float> within_;   ///< squared deviations of heights from their mean, radii squared
  AlignedArray<float> spread_;   ///< half of the squared distance along the surface from the mean, radii squared
};

} // namespace pcl_gpf
