// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_points.h"

#include <algorithm>
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
{
  index_ = input.index;
  std::vector<std::uint32_t> order; // of the arrays in `input`
  if (index_) {
    order.resize(index_->size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
  } else {
    own_index_ = std::make_unique<PointIndex>(input.points, number_of_threads);
    index_ = own_index_.get();
    order = index_->order();
  }
  const PointsView positions = input.index ? index_->sorted() : input.points;
  if constexpr (!std::is_same<Real, float>::value)
    exact_points_ = gather<Real>(positions, input.remainders, order, Real(kFarAway));
  point_normals_ = gather<Real>(input.normals, {}, order, Real(0));
  if (!input.samples) {
    samples_ = gather<Real>(positions, input.remainders, order, Real(kFarAway));
    sample_order_ = std::move(order);
  } else
    sortSamples(input, positions, order);
}

template <typename Real>
void
GPFPoints<Real>::sortSamples(const GPFInput& input, PointsView positions, const std::vector<std::uint32_t>& order)
{
  std::vector<std::uint32_t> place(order.size()); // of each input point among the sorted ones
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = static_cast<std::uint32_t>(i);
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
  samples_ = gather<Real>(positions, input.remainders, seed_points, Real(kFarAway));
  sample_normals_ = gather<Real>(input.normals, {}, seed_points, Real(0));
}

template <typename Real>
void
GPFPoints<Real>::positions(MutableVectorsView out) const
{
  for (std::size_t s = 0; s < sampleCount(); ++s) {
    out.x[sample_order_[s]] = static_cast<float>(samples_.x[s]);
    out.y[sample_order_[s]] = static_cast<float>(samples_.y[s]);
    out.z[sample_order_[s]] = static_cast<float>(samples_.z[s]);
  }
}

template <typename Real>
void
GPFPoints<Real>::displacements(MutableVectorsView out) const
{
  const kernels::Vectors<Real> from = points();
  for (std::size_t s = 0; s < sampleCount(); ++s) {
    const std::size_t seed = seedOf(s);
    out.x[sample_order_[s]] = static_cast<float>(samples_.x[s] - from.x[seed]);
    out.y[sample_order_[s]] = static_cast<float>(samples_.y[s] - from.y[seed]);
    out.z[sample_order_[s]] = static_cast<float>(samples_.z[s] - from.z[seed]);
  }
}

template <typename Real>
void
GPFPoints<Real>::normals(MutableVectorsView out) const
{
  const SortedVectors<Real>& own = sampleNormals();
  for (std::size_t s = 0; s < sampleCount(); ++s) {
    out.x[sample_order_[s]] = static_cast<float>(own.x[s]);
    out.y[sample_order_[s]] = static_cast<float>(own.y[s]);
    out.z[sample_order_[s]] = static_cast<float>(own.z[s]);
  }
}

template class GPFPoints<float>;
template class GPFPoints<double>;

} // namespace pcl_gpf
