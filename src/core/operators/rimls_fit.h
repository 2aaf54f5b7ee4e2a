// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <pcl_gpf/core/operators/rimls_parameters.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Samples as the fits take them, in sorted order and padded. */
struct RimlsSamples {
  kernels::Vectors<float> points;
  SortedVectors<float> normals;
  AlignedArray<float> inverse_sq; ///< 1 / h_i^2
};

/** \brief f and grad f of a batch of queries: the loop over fits around the wide sums. One object serves one task. */
class RimlsFit {
public:
  /** Queries of one task: a multiple of the block whose sums stay in the cache. */
  static constexpr std::size_t kBatch = kBlocksPerTask * kQueryBlock;

  RimlsFit(const RimlsParameters& parameters, const RimlsSamples& samples);

  /** \brief Fits the queries [first, first + count); `first` a multiple of kQueryBlock, count <= kBatch. */
  void
  run(const kernels::Candidates& candidates, kernels::Vectors<float> queries, std::size_t first, std::size_t count);

  bool inside(std::size_t i) const { return inside_[i]; }
  float value(std::size_t i) const { return value_[i]; }
  /** \brief grad f */
  const SortedVectors<float>& gradient() const { return gradient_; }
  /** \brief Typical support radius at a query. */
  float reach(std::size_t i) const;

private:
  void
  closePlainFit(std::size_t count);
  /** \return whether any query of the block goes on */
  bool
  closeFit(std::size_t begin, std::size_t end);

  RimlsParameters parameters_;
  kernels::ImplicitSums sums_;
  SortedVectors<float> gradient_, normal_, slope_, tilt_;
  AlignedArray<float> value_, weight_, height_, count_, close_count_, inverse_sq_, plain_weight_;
  std::vector<std::uint8_t> inside_, done_;
};

} // namespace pcl_gpf
