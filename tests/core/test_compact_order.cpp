// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include "core/compact_order.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace pcl_gpf {
namespace {

using test::toBuffer;
using test::Vector3;

SoaBuffer
makeCloud(std::size_t size, const std::function<Vector3(SplitMix64&)>& point)
{
  SplitMix64 random(size + 1);
  std::vector<Vector3> points(size);
  for (Vector3& p : points)
    p = point(random);
  return toBuffer(points);
}

Vector3
onWaves(SplitMix64& r)
{
  const double x = r.uniform(), y = r.uniform();
  return {x, y, 0.1 * std::sin(9 * x + 4 * y) + 0.01 * r.uniform()};
}

Vector3
onFewPlaces(SplitMix64& r)
{
  return {0.5 * static_cast<double>(r.below(3)), 0, 0.25 * static_cast<double>(r.below(2))};
}

/** Sum of the areas that discs of one radius around boxes of 8 consecutive points would shade, up to a constant: their half perimeters. */
double
extents(const SoaBuffer& cloud, const std::vector<std::uint32_t>& order)
{
  double sum = 0;
  for (std::size_t begin = 0; begin < order.size(); begin += 8)
    for (const float* axis : {cloud.x.data(), cloud.y.data(), cloud.z.data()}) {
      const auto ends = std::minmax_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                            order.begin() + static_cast<std::ptrdiff_t>(std::min(begin + 8, order.size())),
                                            [&](std::uint32_t a, std::uint32_t b) { return axis[a] < axis[b]; });
      sum += static_cast<double>(axis[*ends.second] - axis[*ends.first]);
    }
  return sum;
}

TEST(CompactOrder, PermutesEachPatchOfTheCurve)
{
  for (const std::size_t size : {0u, 1u, 2u, 3u, 8u, 255u, 256u, 257u, 1000u, 40000u}) {
    for (const auto& point : {onWaves, onFewPlaces}) {
      const SoaBuffer cloud = makeCloud(size, point);
      auto curve = hilbertOrder(cloud.view(), 1), order = compactOrder(cloud.view(), 1);
      EXPECT_EQ(compactOrder(cloud.view(), 3), order) << size;
      ASSERT_EQ(order.size(), size);
      for (std::size_t begin = 0; begin < size; begin += 256) {
        const auto end = static_cast<std::ptrdiff_t>(std::min(size, begin + 256));
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + end);
        std::sort(curve.begin() + static_cast<std::ptrdiff_t>(begin), curve.begin() + end);
      }
      EXPECT_EQ(order, curve) << size;
    }
  }
}

TEST(CompactOrder, KeepsTheOrderOfCoincidentPoints)
{
  const SoaBuffer cloud = makeCloud(1000, onFewPlaces);
  const auto order = compactOrder(cloud.view(), 2);
  const auto place = [&](std::uint32_t i) { return std::array<float, 3>{cloud.x[i], cloud.y[i], cloud.z[i]}; };
  std::vector<std::uint32_t> sorted = order;
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (place(sorted[k - 1]) == place(sorted[k])) {
      EXPECT_LT(sorted[k - 1], sorted[k]);
    }
}

TEST(CompactOrder, BoxesOfClustersAreSmallerThanOnTheCurve)
{
  const SoaBuffer cloud = makeCloud(20000, onWaves);
  EXPECT_LT(extents(cloud, compactOrder(cloud.view(), 1)), 0.9 * extents(cloud, hilbertOrder(cloud.view(), 1)));
}

TEST(CompactOrder, PutsAGridIntoCubes)
{
  std::vector<Vector3> cells;
  for (int k = 0; k < 256; ++k)
    cells.push_back({(k & 7) / 7.0, ((k >> 3) & 7) / 7.0, (k >> 6) / 7.0});
  const SoaBuffer grid = toBuffer(cells);
  EXPECT_NEAR(extents(grid, compactOrder(grid.view(), 1)), 32 * 3 / 7.0, 1e-5); // 2 x 2 x 2 cells each
}

} // namespace
} // namespace pcl_gpf
