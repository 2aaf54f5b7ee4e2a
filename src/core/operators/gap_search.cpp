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

/** Least squared distance of `b` from the lines through the neighbours along their normals; stops below `enough`. */
float
clearance(const GapSearch::Scratch& s, std::size_t padded, const std::array<float, 3>& b, float enough)
{
  float least[kGroup];
  std::fill_n(least, kGroup, s.x[0] + 1e30f);
  float all = 1e30f;
  for (std::size_t first = 0; first < padded; first += kGroup) {
    for (std::size_t c = 0; c < kGroup; ++c) {
      const float ex = b[0] - s.x[first + c], ey = b[1] - s.y[first + c], ez = b[2] - s.z[first + c];
      const float along = ex * s.nx[first + c] + ey * s.ny[first + c] + ez * s.nz[first + c];
      const float across_sq = ex * ex + ey * ey + ez * ez - along * along;
      least[c] = across_sq < least[c] ? across_sq : least[c];
    }
    float pair[kGroup / 2];
    for (std::size_t c = 0; c < kGroup / 2; ++c)
      pair[c] = std::min(least[c], least[c + kGroup / 2]);
    all = std::min(std::min(pair[0], pair[1]), std::min(pair[2], pair[3]));
    if (all <= enough)
      break;
  }
  return all;
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
GapSearch::collect(const PointIndex& points, NormalsView normals, std::size_t v, float radius, Scratch& s)
{
  const PointsView p = points.sorted();
  const std::array<float, 3> centre{p.x[v], p.y[v], p.z[v]};
  s.runs.clear();
  s.near.clear();
  points.tree().collectRuns({centre, centre}, radius, s.runs);
  const float radius_sq = radius * radius;
  for (const Run run : s.runs)
    for (std::uint32_t j = run.begin; j < run.end; ++j) {
      const float dx = p.x[j] - centre[0], dy = p.y[j] - centre[1], dz = p.z[j] - centre[2];
      const float distance_sq = dx * dx + dy * dy + dz * dz;
      if (distance_sq < radius_sq && j != v)
        s.near.emplace_back(distance_sq, j);
    }
  if (s.near.size() >= kMostNeighbors) {
    std::nth_element(s.near.begin(), s.near.begin() + (kMostNeighbors - 1), s.near.end());
    s.near.resize(kMostNeighbors - 1);
  }
  s.near.emplace_back(0.0f, static_cast<std::uint32_t>(v)); // last, so that it is no candidate but counts as a neighbour
  std::size_t count = 0;
  for (const auto& [distance_sq, j] : s.near) {
    s.x[count] = p.x[j] - centre[0];
    s.y[count] = p.y[j] - centre[1];
    s.z[count] = p.z[j] - centre[2];
    s.nx[count] = normals.x[j];
    s.ny[count] = normals.y[j];
    s.nz[count] = normals.z[j];
    s.place[count++] = j;
  }
  for (std::size_t c = count; c % kGroup != 0; ++c) {
    s.x[c] = 1e10f; // its square is finite, and no clearance is as large
    s.y[c] = s.z[c] = s.nx[c] = s.ny[c] = s.nz[c] = 0.0f;
  }
  return count;
}

Gap
GapSearch::widest(const PointIndex& points, NormalsView normals, std::size_t v, float radius, Scratch& s) const
{
  const std::size_t count = collect(points, normals, v, radius, s);
  const std::size_t padded = (count + kGroup - 1) / kGroup * kGroup;
  const float nx = normals.x[v], ny = normals.y[v], nz = normals.z[v];
  Gap gap;
  for (std::size_t t = 0; t + 1 < count; ++t) {
    float cosine = nx * s.nx[t] + ny * s.ny[t] + nz * s.nz[t];
    if (!sign_invariant_ && cosine < kOpposite)
      continue;
    const float along = nx * s.x[t] + ny * s.y[t] + nz * s.z[t];
    const float distance_sq = s.x[t] * s.x[t] + s.y[t] * s.y[t] + s.z[t] * s.z[t];
    const float aligned = std::abs(cosine);
    if (aligned > kParallel && along * along > kSteepSq * distance_sq)
      continue;
    const float factor = edgeFactor(sign_invariant_ ? aligned : cosine);
    const float enough = gap.priority / factor;
    if (0.25f * distance_sq <= enough)
      continue;
    const std::array<float, 3> b{0.5f * s.x[t], 0.5f * s.y[t], 0.5f * s.z[t]};
    const float clearance_sq = clearance(s, padded, b, enough);
    if (clearance_sq * factor > gap.priority) {
      gap.clearance_sq = clearance_sq;
      gap.priority = clearance_sq * factor;
      gap.base = b;
      gap.partner = s.place[t];
    }
  }
  const PointsView p = points.sorted();
  gap.base = {p.x[v] + gap.base[0], p.y[v] + gap.base[1], p.z[v] + gap.base[2]};
  return gap;
}

} // namespace pcl_gpf
