// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/operators/steered_fit.h>

#include "../sorted_points.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Data of steered plane fits along the curve: the points of a filtered cloud, or means of them where neighbourhoods hold many. */
struct SteeredGuide {
  SortedVectors<float> positions, normals; ///< normals of unit length and free sign
  SortedVectors<float> residuals;          ///< from a datum to the noisy points that it stands for, their mean
  AlignedArray<float> weights;             ///< number of these points; empty: each datum is a point
  ClusterTree tree;                        ///< over the positions
  std::vector<std::uint32_t> order;        ///< row of each sorted point
  std::vector<std::uint32_t> mean_of;      ///< datum of each sorted point; empty: its own place

  std::size_t size() const { return positions.size(); }
  PointsView view() const { return {positions.x.data(), positions.y.data(), positions.z.data(), size()}; }
  NormalsView normalsView() const { return {normals.x.data(), normals.y.data(), normals.z.data(), size()}; }
  bool merged() const { return !weights.empty(); }
  std::size_t datumOf(std::size_t sorted_place) const { return merged() ? mean_of[sorted_place] : sorted_place; }
};

/** \param[in] noisy, positions, normals rows of points before and after the filter */
SteeredGuide
steeredGuide(const SteeredFitParameters& parameters, PointsView noisy, PointsView positions, NormalsView normals, std::size_t threads);

} // namespace pcl_gpf
