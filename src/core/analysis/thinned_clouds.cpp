// SPDX-License-Identifier: BSD-3-Clause
#include "thinned_clouds.h"

namespace pcl_gpf {

namespace {

constexpr std::size_t kThinning = 8;
constexpr std::size_t kFewestPoints = 1000;

} // namespace

ThinnedClouds::ThinnedClouds(const PointIndex& points, std::size_t threads) : whole_(points)
{
  PointsView finer = points.sorted();
  while (finer.size / kThinning >= kFewestPoints) {
    thinned_.emplace_back();
    Cloud& cloud = thinned_.back();
    cloud.points = SoaBuffer(finer.size / kThinning);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      cloud.points.x[i] = finer.x[i * kThinning];
      cloud.points.y[i] = finer.y[i * kThinning];
      cloud.points.z[i] = finer.z[i * kThinning];
    }
    finer = cloud.points.view();
    cloud.tree.fit(finer, threads);
  }
}

void
ThinnedClouds::collect(std::size_t level, const std::array<float, 3>& center, double radius, std::vector<Run>& runs,
                       std::vector<Offset>& found) const
{
  const PointsView points = level == 0 ? whole_.sorted() : thinned_[level - 1].points.view();
  const ClusterTree& tree = level == 0 ? whole_.tree() : thinned_[level - 1].tree;
  const auto radius_float = static_cast<float>(radius);
  runs.clear();
  found.clear();
  tree.collectRuns({center, center}, radius_float, runs);
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const float x = points.x[i] - center[0], y = points.y[i] - center[1], z = points.z[i] - center[2];
      if (x * x + y * y + z * z <= radius_float * radius_float)
        found.push_back({x, y, z});
    }
}

} // namespace pcl_gpf
