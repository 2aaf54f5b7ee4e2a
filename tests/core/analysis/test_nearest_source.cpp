// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/nearest_source.h>

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

TEST(NearestSource, isTheNearestOnOneFaceAndTheRightFaceBesideAnEdge)
{
  const LocalCloud cloud = toLocalCloud(edge(4000, 0, 3));
  std::vector<Vector3> positions, normals;
  std::vector<std::size_t> expected_face;
  for (std::size_t i = 0; i < cloud.size(); i += 7) {
    positions.push_back(cloud.v[i]);
    normals.push_back(cloud.b[i]);
  }
  const SoaBuffer at = toBuffer(positions), n = toBuffer(normals);
  const auto sources = nearestOnSameSide(cloud.points.view(), cloud.normals.view(), at.view(), n.view());
  ASSERT_EQ(sources.size(), positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) {
    EXPECT_EQ(cloud.b[sources[k]], normals[k]);
    double nearest = 1e9; // of those on the same face
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.b[i] == normals[k])
        nearest = std::min(nearest, distance(cloud.v[i], positions[k]));
    EXPECT_NEAR(distance(cloud.v[sources[k]], positions[k]), nearest, 1e-6);
  }
}

TEST(NearestSource, takesTheFrontOfAThinPlate)
{
  std::vector<Vector3> points, normals;
  for (int i = 0; i < 100; ++i) // the back is nearer to positions in front of nothing
    for (const double side : {-1.0, 1.0}) {
      points.push_back({0.05 * (i % 10), 0.05 * (i / 10), 0.001 * side});
      normals.push_back({0, 0, side});
    }
  const SoaBuffer p = toBuffer(points), n = toBuffer(normals), at = toBuffer({{0.2, 0.2, -0.01}}), up = toBuffer({{0, 0, 1}});
  const auto sources = nearestOnSameSide(p.view(), n.view(), at.view(), up.view());
  EXPECT_GT(normals[sources[0]][2], 0.0);
}

TEST(NearestSource, withoutAFittingNormalItIsTheNearestOfAll)
{
  const SoaBuffer p = toBuffer({{0, 0, 0}, {1, 0, 0}}), n = toBuffer({{0, 0, 1}, {0, 0, 1}}), at = toBuffer({{0.9, 0, 0}}),
                  down = toBuffer({{0, 0, -1}});
  EXPECT_EQ(nearestOnSameSide(p.view(), n.view(), at.view(), down.view()), std::vector<std::uint32_t>{1});
  EXPECT_TRUE(nearestOnSameSide({}, {}, at.view(), down.view()).empty());
}

} // namespace
} // namespace pcl_gpf::test
