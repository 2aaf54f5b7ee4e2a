// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <pcl_gpf/core/point_index.h>

#include <cmath>
#include <cstddef>

namespace pcl_gpf {

/** \brief A filtered cloud, sorted, and an even part of it that stands for all where points are dense. */
struct FilteredCloudIndex {
  /** \param[in] radius of the balls that will be searched, which hold no more than about kMostData data then */
  FilteredCloudIndex(PointsView positions, NormalsView directions, double radius, double spacing, unsigned number_of_threads)
  : points(positions, number_of_threads)
  , threads(resolveThreads(number_of_threads))
  , normals(gather<float>(directions, {}, points.order(), 0.0f, threads))
  {
    constexpr double kPi = 3.14159265358979323846;
    const double expected = kPi * radius * radius / (spacing * spacing) / kMostData;
    while (static_cast<double>(2 * stride) < expected && 2 * stride < points.size())
      stride *= 2;
    const std::size_t size = (points.size() + stride - 1) / stride;
    data = SortedVectors<float>(size, kFarAway);
    data_normals = SortedVectors<float>(size);
    const PointsView sorted = points.sorted();
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t from = k * stride;
      data.x[k] = sorted.x[from], data.y[k] = sorted.y[from], data.z[k] = sorted.z[from];
      data_normals.x[k] = normals.x[from], data_normals.y[k] = normals.y[from], data_normals.z[k] = normals.z[from];
    }
    tree.fit({data.x.data(), data.y.data(), data.z.data(), size}, threads);
  }

  /** \brief Place of the k-th datum in the caller's order. */
  std::uint32_t source(std::size_t k) const { return points.order()[k * stride]; }

  /** \brief Data within reach of every sorted point. */
  Neighborhoods neighborhoods(double radius) const { return findNeighborhoods(tree, points.sorted(), radius, threads); }

  /** \brief Sums with all sorted points as queries; fields and results remain to be set. */
  kernels::FieldSums
  sums(double radius, double angle) const
  {
    const PointsView sorted = points.sorted();
    kernels::FieldSums a;
    a.queries = {sorted.x, sorted.y, sorted.z};
    a.query_normals = normals.vectors();
    a.data = data.vectors();
    a.data_normals = data_normals.vectors();
    a.radius.radius_sq = static_cast<float>(radius * radius);
    a.normal_falloff = static_cast<float>(1.0 / (1.0 - std::cos(angle)));
    return a;
  }

  static constexpr double kMostData = 256.0;

  PointIndex points;
  std::size_t threads;
  SortedVectors<float> normals; ///< of points.sorted()
  std::size_t stride = 1;       ///< every stride-th sorted point is a datum
  SortedVectors<float> data, data_normals;
  ClusterTree tree;             ///< over data
};

} // namespace pcl_gpf
