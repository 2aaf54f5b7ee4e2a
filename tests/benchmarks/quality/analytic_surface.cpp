// SPDX-License-Identifier: BSD-3-Clause
#include "analytic_surface.h"

#include <algorithm>
#include <limits>

namespace pcl_gpf::quality {

AnalyticSurface::AnalyticSurface(Parts parts)
    : parts_(std::move(parts))
{
  box_.add(parts_.box_min[0], parts_.box_min[1], parts_.box_min[2]);
  box_.add(parts_.box_max[0], parts_.box_max[1], parts_.box_max[2]);
  double sum = 0;
  for (const auto& patch : parts_.patches)
    areas_.push_back(sum += patch->area());
}

std::vector<SurfaceSample>
AnalyticSurface::sample(std::size_t count, std::uint64_t seed) const
{
  SplitMix64 random(seed);
  std::vector<SurfaceSample> samples(count);
  for (SurfaceSample& s : samples) {
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), random.uniform() * areas_.back());
    const auto part = static_cast<std::size_t>(std::min(found, areas_.end() - 1) - areas_.begin());
    s.part = static_cast<std::uint32_t>(part);
    parts_.patches[part]->sample(random, s.point, s.normal);
  }
  return samples;
}

SurfaceHit
AnalyticSurface::nearest(const Position& p) const
{
  double least = std::numeric_limits<double>::infinity();
  SurfaceHit hit;
  for (std::size_t i = 0; i < parts_.patches.size(); ++i) {
    const double d = parts_.patches[i]->distance(p);
    if (d < least) {
      least = d;
      hit.part = static_cast<std::uint32_t>(i);
    }
  }
  hit.normal = parts_.patches[hit.part]->normalAt(p);
  hit.signed_distance = parts_.inside(p) ? -least : least;
  return hit;
}

std::vector<Position>
AnalyticSurface::edgeSamples(double step) const
{
  std::vector<Position> points;
  for (const BoundarySample& s : sampleCurves(parts_.edges, step))
    points.push_back(s.point);
  return points;
}

} // namespace pcl_gpf::quality
