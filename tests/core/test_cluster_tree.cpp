// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace pcl_gpf {
namespace {

using test::toBuffer;
using test::Vector3;

/** Clouds that a tree finds hard, of any size. */
struct Layout {
  const char* name;
  Vector3 (*point)(SplitMix64& random, std::size_t i);
};

const Layout kLayouts[] = {
    {"volume", [](SplitMix64& r, std::size_t) { return Vector3{r.uniform() - 0.5, r.uniform() - 0.5, r.uniform() - 0.5}; }},
    {"collinear", [](SplitMix64& r, std::size_t) { const double t = r.uniform(); return Vector3{t, 2 * t, -t}; }},
    {"identical", [](SplitMix64&, std::size_t) { return Vector3{0.25, -0.125, 0.5}; }},
    {"few places", [](SplitMix64& r, std::size_t) { return Vector3{0.5 * static_cast<double>(r.below(3)), 0, 0.25 * static_cast<double>(r.below(2))}; }},
    {"far outlier", [](SplitMix64& r, std::size_t i) { return i == 3 ? Vector3{1e6, -1e6, 1e6} : Vector3{r.uniform(), r.uniform(), 0}; }},
};
const std::size_t kSizes[] = {1, 7, 8, 9, 64, 65, 513, 1000};

SoaBuffer
makeCloud(const Layout& layout, std::size_t size)
{
  SplitMix64 random(size);
  std::vector<Vector3> points(size);
  for (std::size_t i = 0; i < size; ++i)
    points[i] = layout.point(random, i);
  return toBuffer(points);
}

SoaBuffer
sortedCloud(const Layout& layout, std::size_t size)
{
  const SoaBuffer cloud = makeCloud(layout, size);
  const auto order = hilbertOrder(cloud.view(), 1);
  SoaBuffer sorted(size);
  for (std::size_t i = 0; i < size; ++i) {
    sorted.x[i] = cloud.x[order[i]];
    sorted.y[i] = cloud.y[order[i]];
    sorted.z[i] = cloud.z[order[i]];
  }
  return sorted;
}

double
gapSquared(const FloatBox& box, const SoaBuffer& cloud, std::size_t i)
{
  double sum = 0;
  const double p[3] = {cloud.x[i], cloud.y[i], cloud.z[i]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, static_cast<double>(box.min[axis]) - p[axis], p[axis] - static_cast<double>(box.max[axis])});
    sum += gap * gap;
  }
  return sum;
}

float
squaredDistance(const SoaBuffer& cloud, std::size_t i, const std::array<float, 3>& q)
{
  const float dx = cloud.x[i] - q[0], dy = cloud.y[i] - q[1], dz = cloud.z[i] - q[2];
  return dx * dx + dy * dy + dz * dz;
}

void
expectExactRuns(const ClusterTree& tree, const SoaBuffer& cloud, const FloatBox& box, float radius)
{
  std::vector<Run> runs;
  tree.collectRuns(box, radius, runs);
  std::vector<char> covered(cloud.size(), 0);
  std::uint32_t last = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    ASSERT_LT(runs[r].begin, runs[r].end);
    ASSERT_LE(runs[r].end, cloud.size());
    ASSERT_TRUE(r == 0 || runs[r].begin > last) << "runs touch or overlap";
    last = runs[r].end;
    std::fill(covered.begin() + runs[r].begin, covered.begin() + runs[r].end, 1);
  }
  const double reach_sq = static_cast<double>(radius) * radius * (1 - 1e-6); // what float rounding leaves undecided
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (gapSquared(box, cloud, i) < reach_sq || gapSquared(box, cloud, i) == 0) {
      ASSERT_TRUE(covered[i]) << "point " << i << " of " << cloud.size();
    }
}

void
expectExactNearest(const ClusterTree& tree, const SoaBuffer& cloud, const std::array<float, 3>& query, std::size_t k)
{
  std::vector<float> expected(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    expected[i] = squaredDistance(cloud, i, query);
  std::sort(expected.begin(), expected.end());
  expected.resize(std::min(k, expected.size()));

  std::vector<float> distances;
  std::vector<std::uint32_t> indices;
  tree.nearest(cloud.view(), query, k, distances, &indices);
  ASSERT_EQ(distances.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_NEAR(distances[i], expected[i], 1e-6f * expected[i]) << "neighbour " << i << " of " << k;
  for (std::size_t i = 0; i < indices.size(); ++i)
    ASSERT_NEAR(squaredDistance(cloud, indices[i], query), distances[i], 1e-6f * distances[i]);
  ASSERT_EQ(std::set<std::uint32_t>(indices.begin(), indices.end()).size(), expected.size()) << "a point counts once";
}

TEST(HilbertOrder, isAPermutationForEveryLayoutAndThreadCount)
{
  for (const Layout& layout : kLayouts)
    for (const std::size_t size : kSizes) {
      const SoaBuffer cloud = makeCloud(layout, size);
      const auto order = hilbertOrder(cloud.view(), 1);
      auto sorted = order;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t i = 0; i < size; ++i)
        ASSERT_EQ(sorted[i], i) << layout.name;
      EXPECT_EQ(hilbertOrder(cloud.view(), 3), order) << layout.name;
    }
  EXPECT_TRUE(hilbertOrder({}, 1).empty());
}

TEST(HilbertOrder, keepsTheOrderOfCoincidentPoints)
{
  const SoaBuffer cloud = makeCloud(kLayouts[3], 1000);
  const auto order = hilbertOrder(cloud.view(), 2);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto a = order[i - 1], b = order[i];
    if (cloud.x[a] == cloud.x[b] && cloud.y[a] == cloud.y[b] && cloud.z[a] == cloud.z[b]) {
      EXPECT_LT(a, b);
    }
  }
}

TEST(HilbertOrder, walksTheCellsOfACubeInUnitSteps)
{
  // The defining property of the curve: consecutive cells of a full 8 x 8 x 8 grid share a face.
  std::vector<Vector3> cells;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z)
        cells.push_back({x / 7.0, y / 7.0, z / 7.0});
  const SoaBuffer grid = toBuffer(cells);
  const auto order = hilbertOrder(grid.view(), 1);
  for (std::size_t i = 1; i < order.size(); ++i)
    EXPECT_NEAR(7 * test::distance(cells[order[i - 1]], cells[order[i]]), 1.0, 1e-9) << i;
}

TEST(PointIndex, refusesMorePointsThanIndicesTellApartBeforeReadingOne)
{
  const float none = 0.0f;
  for (const std::size_t count : {std::size_t{1} << 31, (std::size_t{1} << 32) - 1, std::size_t{1} << 32, std::size_t{1} << 40}) {
    const PointsView claimed{&none, &none, &none, count};
    EXPECT_THROW(PointIndex index(claimed), ExcessiveWork) << count;
    EXPECT_THROW(hilbertOrder(claimed, 1), ExcessiveWork) << count;
  }
}

TEST(ClusterTree, runsCoverEveryPointWithinReachOfTheBox)
{
  for (const Layout& layout : kLayouts)
    for (const std::size_t size : kSizes) {
      SCOPED_TRACE(std::string(layout.name) + " " + std::to_string(size));
      const SoaBuffer cloud = sortedCloud(layout, size);
      ClusterTree tree;
      tree.fit(cloud.view(), 2);
      SplitMix64 random(7);
      for (int probe = 0; probe < 40; ++probe) {
        const std::size_t i = random.below(size);
        const auto extent = static_cast<float>(0.1 * random.uniform());
        const FloatBox box{{cloud.x[i], cloud.y[i], cloud.z[i]}, {cloud.x[i] + extent, cloud.y[i] + extent, cloud.z[i]}};
        for (const float radius : {0.0f, 0.01f, 0.2f, 5.0f})
          ASSERT_NO_FATAL_FAILURE(expectExactRuns(tree, cloud, box, radius));
      }
    }
}

TEST(ClusterTree, nearestAgreesWithLookingAtEveryPoint)
{
  for (const Layout& layout : kLayouts)
    for (const std::size_t size : kSizes) {
      SCOPED_TRACE(std::string(layout.name) + " " + std::to_string(size));
      const SoaBuffer cloud = sortedCloud(layout, size);
      ClusterTree tree;
      tree.fit(cloud.view(), 1);
      ASSERT_EQ(tree.size(), size);
      SplitMix64 random(11);
      for (int probe = 0; probe < 10; ++probe) {
        const std::size_t i = random.below(size);
        const std::array<float, 3> on{cloud.x[i], cloud.y[i], cloud.z[i]};
        const std::array<float, 3> off{on[0] + 0.3f, on[1] - 0.2f, on[2] + 0.1f};
        for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{8}, std::size_t{17}, size, size + 5}) {
          ASSERT_NO_FATAL_FAILURE(expectExactNearest(tree, cloud, on, k));
          ASSERT_NO_FATAL_FAILURE(expectExactNearest(tree, cloud, off, k));
        }
      }
    }
}

TEST(ClusterTree, staysExactAfterPointsHaveMoved)
{
  SoaBuffer cloud = sortedCloud(kLayouts[0], 1000);
  ClusterTree tree;
  tree.fit(cloud.view(), 1);
  SplitMix64 random(3);
  for (std::size_t i = 0; i < cloud.size(); ++i) { // some a little, one very far: the order is no longer a curve
    cloud.x[i] += static_cast<float>(0.2 * random.normal());
    cloud.y[i] += i == 500 ? 300.0f : 0.0f;
  }
  tree.fit(cloud.view(), 2);
  for (std::size_t i = 0; i < cloud.size(); i += 50) {
    const std::array<float, 3> q{cloud.x[i], cloud.y[i], cloud.z[i]};
    ASSERT_NO_FATAL_FAILURE(expectExactNearest(tree, cloud, q, 20));
    ASSERT_NO_FATAL_FAILURE(expectExactRuns(tree, cloud, {q, q}, 0.15f));
  }
}

TEST(ClusterTree, refitsToFewerAndToMorePoints)
{
  ClusterTree tree;
  for (const std::size_t size : {std::size_t{1000}, std::size_t{9}, std::size_t{0}, std::size_t{600}}) {
    const SoaBuffer cloud = size > 0 ? sortedCloud(kLayouts[0], size) : SoaBuffer(0);
    tree.fit(cloud.view(), 1);
    ASSERT_NO_FATAL_FAILURE(expectExactNearest(tree, cloud, {0.1f, 0.1f, 0.1f}, 12));
    ASSERT_NO_FATAL_FAILURE(expectExactRuns(tree, cloud, {{0, 0, 0}, {0, 0, 0}}, 0.3f));
  }
}

TEST(ClusterTree, findsEveryBallThatMeetsABox)
{
  const SoaBuffer cloud = sortedCloud(kLayouts[0], 1000);
  std::vector<float> radii(cloud.size());
  SplitMix64 random(5);
  for (std::size_t i = 0; i < radii.size(); ++i)
    radii[i] = static_cast<float>(i == 300 ? 0.6 : 0.1 * random.uniform());
  ClusterTree tree;
  tree.fit(cloud.view(), 1, radii.data());
  std::size_t found = 0;
  for (std::size_t q = 0; q < cloud.size(); q += 20) {
    const FloatBox box{{cloud.x[q], cloud.y[q], cloud.z[q]}, {cloud.x[q] + 0.05f, cloud.y[q], cloud.z[q] + 0.02f}};
    std::vector<pcl_gpf::Run> runs;
    tree.collectRuns(box, 1e-6f, runs);
    std::vector<char> covered(cloud.size(), 0);
    for (const pcl_gpf::Run& run : runs)
      std::fill(covered.begin() + run.begin, covered.begin() + run.end, 1);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      EXPECT_TRUE(covered[i] || gapSquared(box, cloud, i) > static_cast<double>(radii[i]) * radii[i]) << "ball " << i;
    found += static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 1));
  }
  EXPECT_LT(found, 50 * cloud.size() / 2) << "one large ball must not make all of them large";
}

TEST(ClusterTree, boundsAreThoseOfThePoints)
{
  const SoaBuffer cloud = sortedCloud(kLayouts[0], 777);
  ClusterTree tree;
  tree.fit(cloud.view(), 1);
  const FloatBox box = tree.bounds();
  EXPECT_EQ(box.min[0], *std::min_element(cloud.x.begin(), cloud.x.end()));
  EXPECT_EQ(box.max[2], *std::max_element(cloud.z.begin(), cloud.z.end()));
  ClusterTree empty;
  empty.fit({}, 1);
  EXPECT_GT(empty.bounds().min[0], empty.bounds().max[0]);
}

} // namespace
} // namespace pcl_gpf
