// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../merged_points.h"
#include "../sorted_points.h"

#include <pcl_gpf/core/operators/bilateral_normals.h>

#include <cstddef>

namespace pcl_gpf {

/** The rounds of the bilateral normal filter over one cloud in sorted order. Where balls hold many points, all rounds but the last run
 * over the means of clusters. */
class NormalRounds {
public:
  NormalRounds(const BilateralNormalsParameters& parameters, const PointIndex& points, const ProgressCallback& progress);

  /** \param[in,out] normals unit vectors of the sorted points */
  void
  run(SortedVectors<float>& normals, const NeighborSearch& search, BilateralNormalsStatistics& statistics);

private:
  /** All rounds but the last over the means, the last over the points. */
  void
  runMerged(SortedVectors<float>& normals, MergedPoints& merged, BilateralNormalsStatistics& statistics) const;

  kernels::BilateralNormals
  arguments(PointsView queries, const AlignedArray<float>& radius_sq) const;

  Neighborhoods
  neighborhoods(const ClusterTree& tree, PointsView queries, const AlignedArray<float>& radius_sq) const;

  /** One round: `normals` are those of the queries, replaced by what `next` receives. */
  void
  filter(const Neighborhoods& near, kernels::BilateralNormals& a, SortedVectors<float>& normals, const float* weights,
         SortedVectors<float>& next, BilateralNormalsStatistics& statistics) const;

  const BilateralNormalsParameters& parameters_;
  const PointIndex& points_;
  const ProgressCallback& progress_;
  std::size_t threads_;
  double radius_;
  AlignedArray<float> radius_sq_; ///< of each point, when it comes from its neighbours
};

} // namespace pcl_gpf
