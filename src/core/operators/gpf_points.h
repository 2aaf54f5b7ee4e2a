// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <pcl_gpf/core/operators/gpf.h>
#include <pcl_gpf/core/point_index.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** Input points V and projected points X of a GPF recursion, both sorted along the curve, in float or double. */
template <typename Real>
class GPFPoints {
public:
  explicit GPFPoints(const GPFInput& input, unsigned number_of_threads);

  std::size_t pointCount() const { return index_->size(); }
  std::size_t sampleCount() const { return samples_.size(); }

  const PointIndex& index() const { return *index_; }
  /** V in Real. */
  kernels::Vectors<Real>
  points() const;
  kernels::Vectors<Real> pointNormals() const { return point_normals_.vectors(); }
  SortedVectors<Real>& samples() { return samples_; }
  const SortedVectors<Real>& samples() const { return samples_; }
  /** The normals of the seeds. */
  const SortedVectors<Real>&
  sampleNormals() const
  {
    return sample_normals_.size() > 0 ? sample_normals_ : point_normals_;
  }
  /** The same to be changed, apart from the normals of the points. */
  SortedVectors<Real>&
  ownSampleNormals();
  /** Rank of sorted sample s in the caller's order. */
  std::size_t rankOf(std::size_t s) const { return sample_order_.empty() ? s : sample_order_[s]; }
  /** Sorted point that seeded sorted sample s. */
  std::size_t seedOf(std::size_t s) const { return seeds_.empty() ? s : seeds_[s]; }

  void
  positions(MutableVectorsView out) const;
  void
  displacements(MutableVectorsView out) const;
  void
  normals(MutableVectorsView out) const;

private:
  template <typename Value>
  void
  write(MutableVectorsView out, const Value& value) const;
  void
  sortSamples(const GPFInput& input, PointsView positions, const std::vector<std::uint32_t>& order);

  std::unique_ptr<PointIndex> own_index_; ///< when the caller gave none
  const PointIndex* index_;
  SortedVectors<Real> exact_points_; ///< only for Real = double; float reads the index
  SortedVectors<Real> point_normals_;
  std::size_t threads_;
  std::vector<std::uint32_t> sample_order_; ///< rank of each sorted sample; empty: its own place
  std::vector<std::uint32_t> seeds_; ///< sorted point that seeded each sample; empty: sample s was seeded by point s
  SortedVectors<Real> samples_, sample_normals_;
};

} // namespace pcl_gpf
