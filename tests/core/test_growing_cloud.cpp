// SPDX-License-Identifier: BSD-3-Clause
#include "core/operators/growing_cloud.h"

#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

namespace pcl_gpf::test {
namespace {

constexpr float kApart = 1e-6f;

/** Points on a plane, and a pile of copies of one of them. */
SoaBuffer
planeWithPile(std::size_t single, std::size_t copies)
{
  SplitMix64 random(3);
  SoaBuffer points(single + copies);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points.x[k] = k < single ? static_cast<float>(random.uniform()) : points.x[single / 2];
    points.y[k] = k < single ? static_cast<float>(random.uniform()) : points.y[single / 2];
  }
  return points;
}

SoaBuffer
facingUp(std::size_t count)
{
  SoaBuffer normals(count);
  std::fill(normals.z.begin(), normals.z.end(), 1.0f);
  return normals;
}

using Place = std::tuple<float, float, float>;

TEST(PlacesWithoutCopies, KeepEveryPositionAndHardlyACopy)
{
  const SoaBuffer points = planeWithPile(3000, 5000);
  const PointIndex index(points.view());
  const PointsView p = index.sorted();
  const SoaBuffer normals = facingUp(p.size);
  const std::vector<std::uint32_t> places = placesWithoutCopies(p, normals.view(), kApart, true);
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  std::set<Place> kept;
  for (const std::uint32_t k : places)
    kept.emplace(p.x[k], p.y[k], p.z[k]);
  EXPECT_EQ(kept.size(), 3000u);
  EXPECT_LE(places.size(), 3000u + 8u); // a few where the pile ends within a patch of the order
}

TEST(PlacesWithoutCopies, AreAllWithoutPiles)
{
  const SoaBuffer points = planeWithPile(500, 0);
  EXPECT_EQ(placesWithoutCopies(points.view(), facingUp(500).view(), kApart, true).size(), 500u);
  EXPECT_TRUE(placesWithoutCopies(VectorsView{}, VectorsView{}, kApart, true).empty());
}

TEST(PlacesWithoutCopies, OneOfEachDirectionStays)
{
  const SoaBuffer points(200); // all at the origin
  SoaBuffer normals = facingUp(200);
  for (std::size_t k = 0; k < 200; ++k) {
    if (k % 4 == 1)
      std::swap(normals.x[k], normals.z[k]);
    if (k % 4 == 2)
      normals.z[k] = -1.0f;
  }
  EXPECT_EQ(placesWithoutCopies(points.view(), normals.view(), kApart, true), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(placesWithoutCopies(points.view(), normals.view(), kApart, false), (std::vector<std::uint32_t>{0, 1, 2}));
}

} // namespace
} // namespace pcl_gpf::test
