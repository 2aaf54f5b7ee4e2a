// SPDX-License-Identifier: BSD-3-Clause
#include "support/shapes.h"

#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

SoaBuffer
positionsOf(const std::vector<Vector3>& points)
{
  SoaBuffer buffer(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    buffer.x[i] = static_cast<float>(points[i][0]);
    buffer.y[i] = static_cast<float>(points[i][1]);
    buffer.z[i] = static_cast<float>(points[i][2]);
  }
  return buffer;
}

bool
spans(const std::vector<Vector3>& points)
{
  const SoaBuffer buffer = positionsOf(points);
  return spansSurface(buffer.view());
}

TEST(SurfaceExtent, LinesAndPilesSpanNothing)
{
  EXPECT_FALSE(spans({}));
  EXPECT_FALSE(spans({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(spans(std::vector<Vector3>(500, {1, 2, 3})));
  std::vector<Vector3> line;
  for (int i = 0; i < 500; ++i)
    line.push_back({0.1 * i, 0.2 * i, -0.3 * i});
  EXPECT_FALSE(spans(line));
  line.push_back({50, 0, 0}); // one point beside it makes a triangle
  EXPECT_TRUE(spans(line));
  EXPECT_TRUE(spans({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

/** A line from the others to a point far away is none of the surface's. */
TEST(SurfaceExtent, PointsFarAwayDoNotMakeALineOfTheOthers)
{
  for (const double away : {1e3, 1e9, 1e14}) {
    std::vector<Vector3> points = sphere(1000).points;
    points.push_back({away, 0, 0});
    EXPECT_TRUE(spans(points)) << away;
    std::vector<Vector3> pile(500, {0, 0, 0});
    pile.push_back({away, 0, 0});
    EXPECT_FALSE(spans(pile)) << away;
  }
}

} // namespace
} // namespace pcl_gpf::test
