// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <Eigen/Core>

namespace pcl_gpf {

/** One of the vectors, in double. */
inline Eigen::Vector3d
vectorAt(const SortedVectors<float>& vectors, std::size_t k)
{
  return {vectors.x[k], vectors.y[k], vectors.z[k]};
}

inline void
setVector(const Eigen::Vector3d& value, SortedVectors<float>& vectors, std::size_t k)
{
  vectors.x[k] = static_cast<float>(value[0]);
  vectors.y[k] = static_cast<float>(value[1]);
  vectors.z[k] = static_cast<float>(value[2]);
}

} // namespace pcl_gpf
