// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/kernels.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl_gpf {

/** Position of the padded data element that stands for "no neighbour": beyond any radius, its square still finite in float. */
constexpr float kFarAway = 1e18f;

/** Kernels index points with signed 32 bits and read up to a block beyond the end. */
constexpr std::size_t kMostCloudPoints = (std::size_t{1} << 31) - 1 - kQueryBlock;

/** \throws ExcessiveWork if a cloud has more points than indices can tell apart; before anything is read */
inline void
checkPointCount(std::size_t count)
{
  if (count > kMostCloudPoints)
    throw ExcessiveWork(std::to_string(count) + " points; the limit of one cloud is " + std::to_string(kMostCloudPoints));
}

/** \brief Three padded arrays; positions have kFarAway behind their end. */
template <typename Real>
struct SortedVectors {
  AlignedArray<Real> x, y, z;

  SortedVectors() = default;
  explicit SortedVectors(std::size_t size, Real padding = Real(0)) : x(make(size, padding)), y(make(size, padding)), z(make(size, padding)) {}

  std::size_t size() const { return x.size() < kQueryBlock ? 0 : x.size() - kQueryBlock; }
  kernels::Vectors<Real> vectors() const { return {x.data(), y.data(), z.data()}; }
  kernels::MutableVectors<Real> vectors() { return {x.data(), y.data(), z.data()}; }

  /** \brief As float; `storage` is used only when Real is not float. */
  VectorsView
  floatView(SoaBuffer& storage) const
  {
    if constexpr (std::is_same<Real, float>::value)
      return {x.data(), y.data(), z.data(), size()};
    else {
      if (storage.size() != size())
        storage = SoaBuffer(size());
      for (std::size_t i = 0; i < size(); ++i) {
        storage.x[i] = static_cast<float>(x[i]);
        storage.y[i] = static_cast<float>(y[i]);
        storage.z[i] = static_cast<float>(z[i]);
      }
      return storage.view();
    }
  }

private:
  static AlignedArray<Real>
  make(std::size_t size, Real padding)
  {
    AlignedArray<Real> array(size + kQueryBlock, padding);
    return array;
  }
};

/** \brief Copies `from` in the order of `order`, or as it is when that is empty, adding remainders if there are any. */
template <typename Real>
SortedVectors<Real>
gather(VectorsView from, VectorsView remainders, const std::vector<std::uint32_t>& order, Real padding, std::size_t threads = 1)
{
  constexpr std::size_t kPointsPerTask = 16384;
  const std::size_t count = order.empty() ? from.size : order.size();
  SortedVectors<Real> to(count, padding);
  const auto one = [&](const float* values, const float* rest, AlignedArray<Real>& target, std::size_t i) {
    const std::size_t place = order.empty() ? i : order[i];
    target[i] = static_cast<Real>(values[place]) + (rest ? static_cast<Real>(rest[place]) : Real(0));
  };
  parallelBlocks(count, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      one(from.x, remainders.x, to.x, i);
      one(from.y, remainders.y, to.y, i);
      one(from.z, remainders.z, to.z, i);
    }
  });
  return to;
}

/** \brief Pointers to candidates as the kernels take them. */
inline kernels::Candidates
candidatesOf(const Neighborhoods& neighborhoods)
{
  if (neighborhoods.foreign())
    return {neighborhoods.query_count, nullptr, nullptr, neighborhoods.absent, neighborhoods.lane_offsets.data(), neighborhoods.lanes.data()};
  return {neighborhoods.query_count, neighborhoods.run_offsets.data(), neighborhoods.runs.data(), neighborhoods.absent, nullptr, nullptr};
}

/** Blocks of queries that one task takes: enough to hide its cost, few enough to balance. */
constexpr std::size_t kBlocksPerTask = 32;

inline std::size_t
blockCount(std::size_t queries)
{
  return (queries + kQueryBlock - 1) / kQueryBlock;
}

} // namespace pcl_gpf
