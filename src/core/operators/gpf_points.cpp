// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_points.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <type_traits>

namespace pcl_gpf {

template <typename Real>
kernels::Vectors<Real>
GPFPoints<Real>::points() const
{
  if constexpr (std::is_same<Real, float>::value) {
    const PointsView sorted = index_->sorted();
    return {sorted.x, sorted.y, sorted.z};
  } else
    return exact_points_.vectors();
}

template <typename Real>
GPFPoints<Real>::GPFPoints(const GPFInput& input, unsigned number_of_threads)
: threads_(resolveThreads(number_of_threads))
{
  index_ = input.index;
  std::vector<std::uint32_t> order; // of the arrays in `input`; empty: that of the index
  if (!index_) {
    own_index_ = std::make_unique<PointIndex>(input.points, number_of_threads);
    index_ = own_index_.get();
    order = index_->order();
  }
  const PointsView positions = input.index ? index_->sorted() : input.points;
  if constexpr (!std::is_same<Real, float>::value)
    exact_points_ = gather<Real>(positions, input.remainders, order, Real(kFarAway), threads_);
  point_normals_ = gather<Real>(input.normals, {}, order, Real(0), threads_);
  if (!input.samples) {
    samples_ = gather<Real>(positions, input.remainders, order, Real(kFarAway), threads_);
    sample_order_ = std::move(order);
  } else
    sortSamples(input, positions, order);
}

template <typename Real>
void
GPFPoints<Real>::sortSamples(const GPFInput& input, PointsView positions, const std::vector<std::uint32_t>& order)
{
  std::vector<std::uint32_t> place(index_->size()); // of each input point among the sorted ones
  for (std::size_t i = 0; i < place.size(); ++i)
    place[order.empty() ? i : order[i]] = static_cast<std::uint32_t>(i);
  sample_order_.resize(input.sample_count);
  std::iota(sample_order_.begin(), sample_order_.end(), std::uint32_t{0});
  std::sort(sample_order_.begin(), sample_order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t place_a = place[input.samples[a]], place_b = place[input.samples[b]];
    return place_a != place_b ? place_a < place_b : a < b;
  });
  seeds_.resize(input.sample_count);
  std::vector<std::uint32_t> seed_points(input.sample_count);
  for (std::size_t s = 0; s < input.sample_count; ++s) {
    seed_points[s] = input.samples[sample_order_[s]];
    seeds_[s] = place[seed_points[s]];
  }
  samples_ = SortedVectors<Real>(0, Real(kFarAway));
  if (seed_points.empty()) // which gather() would take for all points
    return;
  samples_ = gather<Real>(positions, input.remainders, seed_points, Real(kFarAway), threads_);
  sample_normals_ = gather<Real>(input.normals, {}, seed_points, Real(0), threads_);
}

template <typename Real>
SortedVectors<Real>&
GPFPoints<Real>::ownSampleNormals()
{
  if (sample_normals_.size() == 0) {
    sample_normals_ = SortedVectors<Real>(point_normals_.size());
    std::copy_n(point_normals_.x.data(), sampleCount(), sample_normals_.x.data());
    std::copy_n(point_normals_.y.data(), sampleCount(), sample_normals_.y.data());
    std::copy_n(point_normals_.z.data(), sampleCount(), sample_normals_.z.data());
  }
  return sample_normals_;
}

/** out[rank of s] = value(s), three values a sample. */
template <typename Real>
template <typename Value>
void
GPFPoints<Real>::write(MutableVectorsView out, const Value& value) const
{
  constexpr std::size_t kPointsPerTask = 16384;
  parallelBlocks(sampleCount(), kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const std::array<Real, 3> v = value(s);
      const std::size_t rank = rankOf(s);
      out.x[rank] = static_cast<float>(v[0]);
      out.y[rank] = static_cast<float>(v[1]);
      out.z[rank] = static_cast<float>(v[2]);
    }
  });
}

template <typename Real>
void
GPFPoints<Real>::positions(MutableVectorsView out) const
{
  write(out, [&](std::size_t s) { return std::array<Real, 3>{samples_.x[s], samples_.y[s], samples_.z[s]}; });
}

template <typename Real>
void
GPFPoints<Real>::displacements(MutableVectorsView out) const
{
  const kernels::Vectors<Real> from = points();
  write(out, [&](std::size_t s) {
    const std::size_t seed = seedOf(s);
    return std::array<Real, 3>{samples_.x[s] - from.x[seed], samples_.y[s] - from.y[seed],
                               samples_.z[s] - from.z[seed]};
  });
}

template <typename Real>
void
GPFPoints<Real>::normals(MutableVectorsView out) const
{
  const SortedVectors<Real>& own = sampleNormals();
  write(out, [&](std::size_t s) { return std::array<Real, 3>{own.x[s], own.y[s], own.z[s]}; });
}

template class GPFPoints<float>;
template class GPFPoints<double>;

} // namespace pcl_gpf
