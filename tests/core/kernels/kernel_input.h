// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/sorted_points.h"

#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/simd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace pcl_gpf::test {

/** \brief The kernel sets that can run on this processor. */
inline std::vector<const kernels::KernelTarget*>
usableKernels()
{
  const auto names = availableSimdTargets();
  std::size_t count = 0;
  const kernels::KernelTarget* built = kernels::builtTargets(&count);
  std::vector<const kernels::KernelTarget*> usable;
  for (std::size_t i = 0; i < count; ++i)
    if (std::find(names.begin(), names.end(), built[i].name) != names.end())
      usable.push_back(&built[i]);
  return usable;
}

/** \brief Random queries and data in the unit cube, with normals, weights and candidates, laid out as the kernels want them. */
template <typename Real>
struct KernelInput {
  std::size_t query_count, data_count;
  SortedVectors<Real> queries, query_normals, data, data_normals;
  AlignedArray<Real> weight, density; ///< of the data
  AlignedArray<Real> radius_sq;       ///< of the queries
  Neighborhoods near;
  std::vector<std::vector<std::uint32_t>> candidates; ///< of every query, in the order of the kernel

  KernelInput(std::size_t queries_wanted, std::size_t data_wanted, bool lists, std::uint64_t seed)
  : query_count(queries_wanted), data_count(data_wanted)
  {
    SplitMix64 random(seed);
    fill(random, query_count, queries, query_normals);
    fill(random, data_count, data, data_normals);
    weight = positive(random, data_count);
    density = positive(random, data_count);
    radius_sq = positive(random, query_count);
    if (lists)
      chooseLists(random);
    else
      chooseRuns(random);
  }

private:
  static void
  fill(SplitMix64& random, std::size_t count, SortedVectors<Real>& points, SortedVectors<Real>& normals)
  {
    points = SortedVectors<Real>(count, Real(kFarAway));
    normals = SortedVectors<Real>(count, Real(0));
    for (std::size_t i = 0; i < count; ++i) {
      points.x[i] = static_cast<Real>(random.uniform());
      points.y[i] = static_cast<Real>(random.uniform());
      points.z[i] = static_cast<Real>(random.uniform());
      const double n[3] = {random.normal(), random.normal(), random.normal()};
      const double length = std::hypot(n[0], n[1], n[2]);
      normals.x[i] = static_cast<Real>(n[0] / length);
      normals.y[i] = static_cast<Real>(n[1] / length);
      normals.z[i] = static_cast<Real>(n[2] / length);
    }
  }

  /** Values in [0.1, 1); the padding is 1. */
  static AlignedArray<Real>
  positive(SplitMix64& random, std::size_t count)
  {
    AlignedArray<Real> values(count + kQueryBlock, Real(1));
    for (std::size_t i = 0; i < count; ++i)
      values[i] = static_cast<Real>(0.1 + 0.9 * random.uniform());
    return values;
  }

  void
  chooseRuns(SplitMix64& random)
  {
    near.query_count = query_count;
    near.absent = data_count;
    near.run_offsets.push_back(0);
    for (std::size_t block = 0; block < blockCount(query_count); ++block) {
      std::vector<std::uint32_t> streamed;
      std::uint32_t begin = 0;
      while (begin < data_count) {
        const std::uint64_t longest = random.below(4) == 0 ? 1200 : 40;
        const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(data_count, begin + 1 + random.below(longest)));
        near.runs.push_back({begin, end});
        for (std::uint32_t j = begin; j < end; ++j)
          streamed.push_back(j);
        begin = end + static_cast<std::uint32_t>(random.below(10));
      }
      near.run_offsets.push_back(near.runs.size());
      for (std::size_t q = block * kQueryBlock; q < std::min(query_count, (block + 1) * kQueryBlock); ++q)
        candidates.push_back(streamed);
    }
  }

  void
  chooseLists(SplitMix64& random)
  {
    NeighborLists lists;
    lists.offsets.push_back(0);
    for (std::size_t q = 0; q < query_count; ++q) {
      const std::uint64_t stride = 1 + random.below(5);
      candidates.emplace_back();
      for (std::uint64_t j = random.below(stride + 1); j < data_count; j += stride)
        candidates.back().push_back(static_cast<std::uint32_t>(j));
      lists.indices.insert(lists.indices.end(), candidates.back().begin(), candidates.back().end());
      lists.offsets.push_back(lists.indices.size());
    }
    near = transposeLists(lists, query_count, data_count);
  }
};

/** \brief Named outputs of a kernel, each one value a query. */
template <typename Real>
class KernelOutput {
public:
  KernelOutput(std::size_t query_count, std::size_t channels) : query_count_(query_count)
  {
    for (std::size_t c = 0; c < channels; ++c)
      arrays_.emplace_back(query_count + kQueryBlock, Real(-7));
  }
  Real* channel(std::size_t c) { return arrays_[c].data(); }
  kernels::MutableVectors<Real> vectors(std::size_t c) { return {channel(c), channel(c + 1), channel(c + 2)}; }
  std::size_t channels() const { return arrays_.size(); }
  Real value(std::size_t c, std::size_t q) const { return arrays_[c][q]; }

  bool
  sameBits(const KernelOutput& other) const
  {
    for (std::size_t c = 0; c < channels(); ++c)
      if (std::memcmp(arrays_[c].data(), other.arrays_[c].data(), query_count_ * sizeof(Real)) != 0)
        return false;
    return true;
  }

private:
  std::size_t query_count_;
  std::vector<AlignedArray<Real>> arrays_;
};

} // namespace pcl_gpf::test
