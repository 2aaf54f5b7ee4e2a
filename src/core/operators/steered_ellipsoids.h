// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/steered_fit.h>

#include "../sorted_points.h"
#include "normal_tensors.h"

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** The ellipsoids of the queries as matrices, and the balls that hold them. */
struct SteeredEllipsoids {
  SortedVectors<float> diagonal, mixed;
  AlignedArray<float> reach_sq;
};

/** I / (longest_share radius)^2 + bending_weight T / radius^2 for each query, a sorted place. */
SteeredEllipsoids
steeredEllipsoids(const SteeredFitParameters& parameters, const NormalTensors& tensors, const std::vector<std::uint32_t>& queries);

} // namespace pcl_gpf
