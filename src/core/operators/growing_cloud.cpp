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
: size_(points.size()), threads_(threads), rows_(size_), gaps_(size_), places_(size_)
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

void
GrowingCloud::insert(const std::vector<std::uint32_t>& beside, kernels::Vectors<float> positions, kernels::Vectors<float> normals,
                     const std::vector<Gap>& gaps)
{
  const std::size_t count = size_ + beside.size();
  Rows to(count);
  std::vector<Gap> to_gaps(count);
  places_.resize(count);
  parallelBlocks(size_, kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    auto next = static_cast<std::size_t>(std::lower_bound(beside.begin(), beside.end(), begin) - beside.begin());
    for (std::size_t k = begin; k < end; ++k) {
      std::size_t place = k + next;
      to.set(place, {rows_.x[k], rows_.y[k], rows_.z[k]}, {rows_.nx[k], rows_.ny[k], rows_.nz[k]}, rows_.number[k]);
      to_gaps[place] = gaps_[k];
      places_[rows_.number[k]] = static_cast<std::uint32_t>(place);
      if (next == beside.size() || beside[next] != k)
        continue;
      ++place;
      const auto number = static_cast<std::uint32_t>(size_ + next);
      to.set(place, {positions.x[next], positions.y[next], positions.z[next]}, {normals.x[next], normals.y[next], normals.z[next]}, number);
      to_gaps[place] = gaps[next];
      places_[number] = static_cast<std::uint32_t>(place);
      ++next;
    }
  });
  rows_ = std::move(to);
  gaps_ = std::move(to_gaps);
  size_ = count;
  tree_.fit({rows_.x.data(), rows_.y.data(), rows_.z.data(), size_}, threads_);
}

} // namespace pcl_gpf
