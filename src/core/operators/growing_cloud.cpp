// SPDX-License-Identifier: BSD-3-Clause
#include "growing_cloud.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 16384;

} // namespace

GrowingCloud::GrowingCloud(const PointIndex& points, NormalsView normals, std::size_t threads)
: size_(points.size()), threads_(threads), rows_(size_), gaps_(kGapsOfPoint * size_), places_(size_)
{
  const PointsView p = points.sorted();
  const auto copy = [this](const float* from, AlignedArray<float>& to) { std::copy(from, from + size_, to.begin()); };
  copy(p.x, rows_.x);
  copy(p.y, rows_.y);
  copy(p.z, rows_.z);
  copy(normals.x, rows_.nx);
  copy(normals.y, rows_.ny);
  copy(normals.z, rows_.nz);
  std::iota(rows_.number.begin(), rows_.number.end(), 0u);
  std::iota(places_.begin(), places_.end(), 0u);
  tree_.fit(p, threads);
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
  rows_.number = spread(rows_.number, 1, filled, [this](std::size_t c, std::size_t) { return static_cast<std::uint32_t>(size_ + c); });
  gaps_ = spread(gaps_, kGapsOfPoint, filled, [&](std::size_t c, std::size_t) {
    Gap gap;
    gap.clearance_sq = gaps_[filled[c]].clearance_sq;
    return gap;
  });
  size_ += filled.size();
  places_.resize(size_);
  parallelBlocks(size_, kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      places_[rows_.number[k]] = static_cast<std::uint32_t>(k);
  });
  tree_.fit({rows_.x.data(), rows_.y.data(), rows_.z.data(), size_}, threads_);
}

} // namespace pcl_gpf
