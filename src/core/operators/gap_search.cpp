// SPDX-License-Identifier: BSD-3-Clause
#include "gap_search.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kGroup = 8;
constexpr std::size_t kFactorSteps = 1024;
/** Two points whose normals are parallel within 45 degrees, one above the other, lie on two sheets: nothing is missing between. */
constexpr float kParallel = 0.70710678f;
constexpr float kSteepSq = 0.5f;
/** Normals that face apart more than this belong to the two sides of a sheet, not to an edge. */
constexpr float kOpposite = -0.9f;
/** Points are searched together while their box is at most this many times the reach wide. */
constexpr float kWidestBox = 1.0f;
/** Neighbours are sought within at least this many clearances of the gap known before, so that points across a wide one are found, and
 * within at most so many, so that a dense edge costs no more than other places. */
constexpr float kLeastClearances = 3.0f, kMostClearances = 5.0f;

/** Each pair is looked at from one end only; every point has about half of its pairs. */
inline bool
isMine(std::uint32_t v, std::uint32_t t)
{
  return (((v ^ t) & 1u) != 0) == (v < t);
}

} // namespace

GapSearch::GapSearch(double edge_sensitivity, bool sign_invariant)
: edge_factors_(kFactorSteps + 2), sign_invariant_(sign_invariant)
{
  // A table, because pow() of the system need not give the same bits everywhere, and is slow.
  for (std::size_t i = 0; i < edge_factors_.size(); ++i)
    edge_factors_[i] = static_cast<float>(std::pow(1.0 + 2.0 * static_cast<double>(i) / kFactorSteps, edge_sensitivity));
}

float
GapSearch::edgeFactor(float cosine) const
{
  const float step = std::clamp((1.0f - cosine) * (kFactorSteps / 2), 0.0f, static_cast<float>(kFactorSteps));
  const auto i = static_cast<std::size_t>(step);
  const float rest = step - static_cast<float>(i);
  return edge_factors_[i] + rest * (edge_factors_[i + 1] - edge_factors_[i]);
}

std::size_t
GapSearch::Scratch::collect(std::size_t self, float radius)
{
  const NearbyPoints& from = candidates_;
  const float cx = from.x[self], cy = from.y[self], cz = from.z[self];
  const std::size_t candidates = from.size();
  distance_sq_.resize(candidates);
  chosen_.resize(candidates + 1);
  for (std::size_t j = 0; j < candidates; ++j) {
    const float dx = from.x[j] - cx, dy = from.y[j] - cy, dz = from.z[j] - cz;
    distance_sq_[j] = dx * dx + dy * dy + dz * dz;
  }
  const float radius_sq = radius * radius;
  std::size_t count = 0;
  for (std::size_t j = 0; j < candidates; ++j) {
    chosen_[count] = static_cast<std::uint32_t>(j);
    count += (distance_sq_[j] < radius_sq) & (j != self);
  }
  if (count > kMostNeighbors) {
    const auto begin = chosen_.begin(), end = begin + static_cast<std::ptrdiff_t>(count);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(kMostNeighbors), end, [this](std::uint32_t a, std::uint32_t b) {
      return distance_sq_[a] < distance_sq_[b] || (distance_sq_[a] == distance_sq_[b] && a < b);
    });
    count = kMostNeighbors;
  }
  chosen_[count] = static_cast<std::uint32_t>(self);
  for (std::size_t k = 0; k <= count; ++k) {
    const std::uint32_t j = chosen_[k];
    near_.x[k] = from.x[j] - cx;
    near_.y[k] = from.y[j] - cy;
    near_.z[k] = from.z[j] - cz;
    near_.nx[k] = from.nx[j];
    near_.ny[k] = from.ny[j];
    near_.nz[k] = from.nz[j];
    near_.place[k] = from.places[j];
  }
  return count;
}

Gap
GapSearch::widestOf(std::uint32_t v, const std::vector<std::uint32_t>& order, float radius, Scratch& scratch) const
{
  const NearbyPoints& from = scratch.candidates_;
  const auto self = static_cast<std::size_t>(std::lower_bound(from.places.begin(), from.places.end(), v) - from.places.begin());
  const std::size_t count = scratch.collect(self, radius);
  const auto& s = scratch.near_;
  alignas(64) float bx[Scratch::kSize] = {}, by[Scratch::kSize] = {}, bz[Scratch::kSize] = {}, least_sq[Scratch::kSize];
  std::uint32_t partner[Scratch::kSize];
  std::size_t partners = 0;
  for (std::size_t t = 0; t < count; ++t) {
    bx[partners] = 0.5f * s.x[t];
    by[partners] = 0.5f * s.y[t];
    bz[partners] = 0.5f * s.z[t];
    partner[partners] = static_cast<std::uint32_t>(t);
    partners += isMine(order[v], order[s.place[t]]);
  }
  const std::size_t padded = (partners + kGroup - 1) / kGroup * kGroup;
  std::fill_n(least_sq, padded, 1e30f);
  for (std::size_t k = 0; k <= count; ++k) {
    const float x = s.x[k], y = s.y[k], z = s.z[k], nx = s.nx[k], ny = s.ny[k], nz = s.nz[k];
    for (std::size_t t = 0; t < padded; ++t) {
      const float ex = bx[t] - x, ey = by[t] - y, ez = bz[t] - z;
      const float along = ex * nx + ey * ny + ez * nz;
      const float across_sq = ex * ex + ey * ey + ez * ez - along * along;
      least_sq[t] = across_sq < least_sq[t] ? across_sq : least_sq[t];
    }
  }
  Gap gap;
  const float nx = s.nx[count], ny = s.ny[count], nz = s.nz[count];
  for (std::size_t b = 0; b < partners; ++b) {
    const std::size_t t = partner[b];
    const float cosine = nx * s.nx[t] + ny * s.ny[t] + nz * s.nz[t];
    const float along = nx * s.x[t] + ny * s.y[t] + nz * s.z[t];
    const float distance_sq = s.x[t] * s.x[t] + s.y[t] * s.y[t] + s.z[t] * s.z[t];
    const float aligned = std::abs(cosine);
    if ((aligned > kParallel && along * along > kSteepSq * distance_sq) || (!sign_invariant_ && cosine < kOpposite))
      continue;
    const float priority = least_sq[b] * edgeFactor(sign_invariant_ ? aligned : cosine);
    if (priority > gap.priority) {
      gap.clearance_sq = least_sq[b];
      gap.priority = priority;
      gap.base = {from.x[self] + bx[b], from.y[self] + by[b], from.z[self] + bz[b]};
      gap.partner = order[s.place[t]];
    }
  }
  return gap;
}

void
GapSearch::widest(const PointIndex& points, NormalsView normals, std::size_t begin, std::size_t end,
                  std::uint32_t first_new, float reach, float farthest, Scratch& scratch, Gap* gaps) const
{
  const PointsView p = points.sorted();
  const auto position = [&](std::size_t k) { return std::array<float, 3>{p.x[k], p.y[k], p.z[k]}; };
  const auto radius = [&](std::size_t k) {
    const float free = std::sqrt(gaps[k - begin].clearance_sq);
    return std::min(farthest, std::clamp(reach, kLeastClearances * free, kMostClearances * free));
  };
  forPatches(begin, end, kWidestBox * reach, position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
    float largest = 0.0f;
    for (std::size_t k = first; k < last; ++k)
      largest = std::max(largest, radius(k));
    scratch.candidates_.fill(points, normals, box, largest);
    const std::vector<std::uint32_t>& near = scratch.candidates_.places;
    if (std::none_of(near.begin(), near.end(), [&](std::uint32_t j) { return points.order()[j] >= first_new; }))
      return;
    for (std::size_t k = first; k < last; ++k) {
      Gap& gap = gaps[k - begin];
      gap = widestOf(static_cast<std::uint32_t>(k), points.order(), radius(k), scratch);
    }
  });
}

} // namespace pcl_gpf
