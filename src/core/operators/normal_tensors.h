// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Mean of n n^T, trace 1. */
struct NormalTensor {
  float xx = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0;
  float least = 0; ///< smallest eigenvalue, 0 .. 1/3: how much the surface bends in the direction in which it bends least
};

/** Means of n n^T over balls, for every point of a sorted cloud, or every mean of some points; neighbours on the curve share one where balls hold many points. */
class NormalTensors {
public:
  /** \param[in] points in sorted order, followed by padding far away \param[in] tree over them
   * \param[in] normals unit vectors of free sign \param[in] weights number of points that each stands for; null: 1 */
  NormalTensors(PointsView points, const ClusterTree& tree, NormalsView normals, const float* weights, double radius,
                std::size_t threads);

  const NormalTensor&
  of(std::size_t sorted_place) const
  {
    return tensors_[sorted_place / stride_];
  }

private:
  std::size_t stride_ = 1;
  std::vector<NormalTensor> tensors_;
};

} // namespace pcl_gpf
