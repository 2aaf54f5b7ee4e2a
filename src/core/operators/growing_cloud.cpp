// SPDX-License-Identifier: BSD-3-Clause
#include "growing_cloud.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 16384;

/** Cosine above which coincident points face one way; so a pile has a few dozen directions at most. */
constexpr float kOneDirection = 0.97f;

} // namespace

std::vector<std::uint32_t>
placesWithoutCopies(PointsView points, NormalsView normals, float apart, bool sign_invariant)
{
  std::vector<std::uint32_t> places;
  places.reserve(points.size);
  std::size_t pile = 0; // the first of `places` that lies where the last does
  const auto coincide = [&](std::size_t a, std::size_t b) {
    const float x = points.x[a] - points.x[b], y = points.y[a] - points.y[b], z = points.z[a] - points.z[b];
    return x * x + y * y + z * z < apart * apart;
  };
  for (std::uint32_t k = 0; k < points.size; ++k) {
    const auto faces = [&](std::uint32_t j) {
      const float cosine = normals.x[k] * normals.x[j] + normals.y[k] * normals.y[j] + normals.z[k] * normals.z[j];
      return (sign_invariant ? std::abs(cosine) : cosine) > kOneDirection;
    };
    if (places.empty() || !coincide(k, places[pile]))
      pile = places.size();
    else if (std::any_of(places.begin() + static_cast<std::ptrdiff_t>(pile), places.end(), faces))
      continue;
    places.push_back(k);
  }
  return places;
}

GrowingCloud::GrowingCloud(const PointIndex& points, NormalsView normals, const std::vector<std::uint32_t>& places, std::size_t threads)
: size_(places.size()), threads_(threads), rows_(size_), gaps_(kGapsOfPoint * size_), places_(points.size())
{
  const PointsView p = points.sorted();
  const auto copy = [&](const float* from, AlignedArray<float>& to) {
    std::transform(places.begin(), places.end(), to.begin(), [from](std::uint32_t place) { return from[place]; });
  };
  copy(p.x, rows_.x);
  copy(p.y, rows_.y);
  copy(p.z, rows_.z);
  copy(normals.x, rows_.nx);
  copy(normals.y, rows_.ny);
  copy(normals.z, rows_.nz);
  std::copy(places.begin(), places.end(), rows_.number.begin());
  for (std::uint32_t k = 0; k < size_; ++k)
    places_[places[k]] = k;
  tree_.fit({rows_.x.data(), rows_.y.data(), rows_.z.data(), size_}, threads);
}

/** A copy of an array with the values of new points at their places. \param[in] each elements a point */
template <class Array, class ValueOfNew>
Array
GrowingCloud::spread(const Array& from, std::size_t each, const std::vector<std::uint32_t>& filled, const ValueOfNew& value_of_new) const
{
  Array to(each * (size_ + filled.size()));
  parallelBlocks(size_, kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    auto next = static_cast<std::size_t>(std::lower_bound(filled.begin(), filled.end(), kGapsOfPoint * begin) - filled.begin());
    for (std::size_t k = begin; k < end; ++k) {
      for (std::size_t e = 0; e < each; ++e)
        to[each * (k + next) + e] = from[each * k + e];
      for (; next < filled.size() && filled[next] / kGapsOfPoint == k; ++next)
        for (std::size_t e = 0; e < each; ++e)
          to[each * (k + 1 + next) + e] = value_of_new(next, e);
    }
  });
  return to;
}

void
GrowingCloud::insert(const std::vector<std::uint32_t>& filled, kernels::Vectors<float> positions, kernels::Vectors<float> normals)
{
  // One array after another, so that only one is there twice.
  const auto add = [&](AlignedArray<float>& array, const float* values) {
    array = spread(array, 1, filled, [values](std::size_t c, std::size_t) { return values[c]; });
  };
  add(rows_.x, positions.x);
  add(rows_.y, positions.y);
  add(rows_.z, positions.z);
  add(rows_.nx, normals.x);
  add(rows_.ny, normals.y);
  add(rows_.nz, normals.z);
  const std::uint32_t first_number = numberCount();
  rows_.number = spread(rows_.number, 1, filled,
                        [first_number](std::size_t c, std::size_t) { return first_number + static_cast<std::uint32_t>(c); });
  gaps_ = spread(gaps_, kGapsOfPoint, filled, [&](std::size_t c, std::size_t) {
    Gap gap;
    gap.clearance_sq = gaps_[filled[c]].clearance_sq;
    return gap;
  });
  size_ += filled.size();
  places_.resize(places_.size() + filled.size());
  parallelBlocks(size_, kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      places_[rows_.number[k]] = static_cast<std::uint32_t>(k);
  });
  tree_.fit({rows_.x.data(), rows_.y.data(), rows_.z.data(), size_}, threads_);
}

} // namespace pcl_gpf
