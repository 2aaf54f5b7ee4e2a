// SPDX-License-Identifier: BSD-3-Clause
#include "core/merged_points.h"
#include "operators/gpf_run.h"

#include "support/literal_default_gpf.h"

#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/operators/plane_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kPoints = 6000;
constexpr unsigned kMergeAbove = 60;

/** A cloud in sorted order: index and normals of its points. */
struct SortedCloud {
  PointIndex index;
  SoaBuffer normals;

  explicit SortedCloud(const LocalCloud& cloud) : index(cloud.points.view()), normals(cloud.size())
  {
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      normals.x[k] = cloud.normals.x[index.order()[k]];
      normals.y[k] = cloud.normals.y[index.order()[k]];
      normals.z[k] = cloud.normals.z[index.order()[k]];
    }
  }
  Vector3 position(std::size_t k) const { return {index.sorted().x[k], index.sorted().y[k], index.sorted().z[k]}; }
  Vector3 normal(std::size_t k) const { return {normals.x[k], normals.y[k], normals.z[k]}; }
};

double
dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Members of every mean, ascending. */
std::vector<std::vector<std::size_t>>
membersOf(const MergedPoints& merged)
{
  std::vector<std::vector<std::size_t>> members(merged.size());
  for (std::size_t i = 0; i < merged.mean_of.size(); ++i)
    members[merged.mean_of[i]].push_back(i);
  return members;
}

/** Checks that mean m is what its members say. */
void
checkMean(const SortedCloud& cloud, const MergedPoints& merged, const std::vector<std::size_t>& members, std::size_t m, double radius)
{
  ASSERT_FALSE(members.empty());
  ASSERT_EQ(merged.weights[m], static_cast<float>(members.size()));
  const Vector3 first = cloud.normal(members[0]);
  Vector3 position{0, 0, 0}, normal{0, 0, 0};
  Vector3 low = cloud.position(members[0]), high = low;
  for (const std::size_t i : members) {
    const Vector3 p = cloud.position(i), n = cloud.normal(i);
    ASSERT_GE(std::abs(dot(n, first)), static_cast<double>(MergedPoints::kSameDirection) - 1e-6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position[axis] += p[axis] / static_cast<double>(members.size());
      normal[axis] += dot(n, first) < 0 ? -n[axis] : n[axis];
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  ASSERT_LE(distance(low, high), MergedPoints::kWidestShare * radius * (1 + 1e-6));
  ASSERT_LE(distance(position, {merged.positions.x[m], merged.positions.y[m], merged.positions.z[m]}), 1e-7);
  const double length = distance(normal, {0, 0, 0});
  ASSERT_LE(distance({normal[0] / length, normal[1] / length, normal[2] / length},
                     {merged.normals.x[m], merged.normals.y[m], merged.normals.z[m]}),
            1e-6);
}

TEST(MergedPoints, areTheMeansOfTheirMembers)
{
  for (NamedCloud& named : threeClouds(kPoints)) {
    SCOPED_TRACE(named.name);
    for (std::size_t i = 0; i < kPoints; i += 3) // signs are free
      named.cloud.normals.x[i] *= -1, named.cloud.normals.y[i] *= -1, named.cloud.normals.z[i] *= -1;
    const SortedCloud cloud(named.cloud);
    const double radius = 0.2;
    const MergedPoints merged = mergePoints(cloud.index, cloud.normals.view(), {radius}, kMergeAbove, true, 2);
    ASSERT_FALSE(merged.empty());
    ASSERT_EQ(merged.mean_of.size(), kPoints);
    EXPECT_LT(merged.size(), kPoints / 2);
    const auto members = membersOf(merged);
    for (std::size_t m = 0; m < merged.size(); ++m)
      ASSERT_NO_FATAL_FAILURE(checkMean(cloud, merged, members[m], m, radius));
  }
}

TEST(MergedPoints, doNotDependOnTheNumberOfThreads)
{
  const SortedCloud cloud(toLocalCloud(turned(cube(40000, 0.01, 3))));
  const MergedPoints one = mergePoints(cloud.index, cloud.normals.view(), {0.1}, kMergeAbove, true, 1);
  const MergedPoints three = mergePoints(cloud.index, cloud.normals.view(), {0.1}, kMergeAbove, true, 3);
  ASSERT_FALSE(one.empty());
  EXPECT_EQ(one.mean_of, three.mean_of);
  EXPECT_TRUE(sameBits(one.positions.x, three.positions.x) && sameBits(one.positions.y, three.positions.y) &&
              sameBits(one.positions.z, three.positions.z));
  EXPECT_TRUE(sameBits(one.normals.x, three.normals.x) && sameBits(one.weights, three.weights));
}

TEST(MergedPoints, leaveSparsePartsAsTheyAre)
{
  // A dense patch and, far from it, a sparse one whose balls hold few points.
  Shape shape;
  SplitMix64 random(5);
  for (std::size_t i = 0; i < 8000; ++i)
    append(shape, {0.2 * random.uniform(), 0.2 * random.uniform(), 0}, {0, 0, 1});
  for (std::size_t i = 0; i < 1000; ++i)
    append(shape, {2 + random.uniform(), random.uniform(), 0}, {0, 0, 1});
  const LocalCloud local = toLocalCloud(shape);
  const SortedCloud cloud(local);
  const double radius = 0.02; // of the diagonal, 3.2
  const MergedPoints merged = mergePoints(cloud.index, cloud.normals.view(), {radius}, kMergeAbove, true, 1);
  ASSERT_FALSE(merged.empty());
  std::size_t sparse = 0, merged_dense = 0;
  for (std::size_t i = 0; i < cloud.index.size(); ++i) {
    const std::size_t m = merged.mean_of[i];
    if (cloud.index.order()[i] < 8000) {
      merged_dense += merged.weights[m] > 1.0f;
      continue;
    }
    ASSERT_EQ(merged.weights[m], 1.0f);
    ASSERT_EQ(merged.positions.x[m], cloud.index.sorted().x[i]);
    ASSERT_EQ(merged.positions.y[m], cloud.index.sorted().y[i]);
    ++sparse;
  }
  EXPECT_EQ(sparse, 1000u);
  EXPECT_GT(merged_dense, 6000u);
}

TEST(MergedPoints, areNotMadeWhereNothingIsToBeWon)
{
  const SortedCloud cloud(toLocalCloud(turned(sphere(3000, 0.01, 1))));
  EXPECT_TRUE(mergePoints(cloud.index, cloud.normals.view(), {0.2}, 0, true, 1).empty()) << "switched off";
  EXPECT_TRUE(mergePoints(cloud.index, cloud.normals.view(), {0.01}, 200, true, 1).empty()) << "small balls";
  const PointIndex nothing(PointsView{});
  EXPECT_TRUE(mergePoints(nothing, {}, {0.2}, 200, true, 1).empty());
}

TEST(MergedPoints, areMadeOfAPileHoweverFewItsPointsAre)
{
  Shape shape = plane(20000, 0.0, 1);
  for (std::size_t i = 0; i < 3000; ++i) // 13 % of the points, but all pairs of 3,000
    append(shape, {0.3, 0.3, 0}, {0, 0, 1});
  const SortedCloud cloud(toLocalCloud(shape));
  const MergedPoints merged = mergePoints(cloud.index, cloud.normals.view(), {0.02}, 200, true, 2);
  ASSERT_FALSE(merged.empty());
  EXPECT_LT(merged.size(), 20000u + 2 * 1024u); // the two chunks that the pile begins and ends in may stay
  EXPECT_GT(merged.size(), 18000u);
}

TEST(MergedPoints, surviveCoincidentPoints)
{
  SoaBuffer points(3001);
  points.x[3000] = 1.0f;
  const PointIndex index(points.view());
  const MergedPoints merged = mergePoints(index, {}, {0.1}, 100, true, 1);
  ASSERT_FALSE(merged.empty());
  EXPECT_EQ(std::accumulate(merged.weights.begin(), merged.weights.end(), 0.0f), 3001.0f);
  for (std::size_t m = 0; m < merged.size(); ++m)
    EXPECT_TRUE(merged.positions.x[m] == 0.0f || (merged.positions.x[m] == 1.0f && merged.weights[m] == 1.0f));
}

TEST(MergedPoints, takeTheRadiusOfEveryPoint)
{
  const SortedCloud cloud(toLocalCloud(turned(sphere(kPoints, 0.01, 1))));
  AlignedArray<float> radius_sq(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
    radius_sq[i] = cloud.index.sorted().z[i] > 0 ? 0.04f : 1e-6f;
  const MergedPoints merged = mergePoints(cloud.index, cloud.normals.view(), {0.0, radius_sq.data()}, kMergeAbove, true, 1);
  ASSERT_FALSE(merged.empty());
  const auto members = membersOf(merged);
  for (const auto& of_mean : members)
    for (const std::size_t i : of_mean)
      if (of_mean.size() > 1) {
        ASSERT_GT(cloud.index.sorted().z[i], 0.0f) << "wider than a share of the smallest radius";
      }
}

TEST(GPFMerged, equalsTheSumsOverMeansWrittenOutInDouble)
{
  for (const NamedCloud& named : threeClouds(3000)) {
    SCOPED_TRACE(named.name);
    GPFParameters p;
    p.support_radius = 0.4;
    p.merge_above = kMergeAbove;
    const SortedCloud sorted(named.cloud);
    GPFInput input;
    input.index = &sorted.index;
    input.normals = sorted.normals.view();
    const MergedPoints merged = mergePoints(sorted.index, sorted.normals.view(), {0.2}, kMergeAbove, false, 1);
    ASSERT_FALSE(merged.empty());
    std::vector<Vector3> v, b;
    for (std::size_t m = 0; m < merged.size(); ++m) {
      v.push_back({merged.positions.x[m], merged.positions.y[m], merged.positions.z[m]});
      b.push_back({merged.normals.x[m], merged.normals.y[m], merged.normals.z[m]});
    }
    const LiteralDefaultGPF literal{p, v, b, &merged.weights};
    GPFState state = gpfInit(p, input);
    const std::vector<Vector3> n = toVectors(sorted.normals);
    std::size_t undecided = 0;
    for (int step = 0; step < 3; ++step) {
      const std::vector<Vector3> before = toVectors(positionsOf(state));
      EXPECT_EQ(gpfStep(state).isolated_points, 0u);
      const std::vector<Vector3> after = toVectors(positionsOf(state));
      for (std::size_t m = 0; m < before.size(); m += 3) {
        bool open = false;
        const Vector3 move = literal.displacement(before, n, m, false, open);
        undecided += open;
        if (!open) {
          ASSERT_LE(distance(after[m], {before[m][0] + move[0], before[m][1] + move[1], before[m][2] + move[2]}),
                    1e-4 * p.support_radius);
        }
      }
    }
    EXPECT_LT(undecided, 150u);
  }
}

/** Mean distance of results from those without merging, and of the movement itself. */
TEST(GPFMerged, staysCloseToTheSumsOverAllPoints)
{
  for (const NamedCloud& named : threeClouds(20000)) {
    GPFParameters p;
    p.support_radius = 0.15;
    p.merge_above = 100;
    const SoaBuffer merged = runSteps(p, inputOf(named.cloud), 4);
    p.merge_above = 0;
    const SoaBuffer all = runSteps(p, inputOf(named.cloud), 4);
    double difference = 0, movement = 0;
    const auto a = toVectors(all), m = toVectors(merged);
    for (std::size_t i = 0; i < a.size(); ++i) {
      difference += distance(a[i], m[i]);
      movement += distance(a[i], named.cloud.v[i]);
    }
    EXPECT_GT(difference, 0.0) << named.name << ": nothing was merged";
    EXPECT_LT(difference, 0.06 * movement) << named.name;
  }
}

TEST(NormalsMerged, stayCloseToTheSumsOverAllPoints)
{
  for (const NamedCloud& named : threeClouds(20000)) {
    SCOPED_TRACE(named.name);
    SoaBuffer normals[2];
    for (const unsigned merge_above : {0u, 100u}) {
      SoaBuffer& of_run = normals[merge_above > 0];
      of_run = SoaBuffer(named.cloud.size());
      PlaneNormalsParameters plane;
      plane.radius = 0.06;
      plane.merge_above = merge_above;
      estimatePlaneNormals(plane, named.cloud.points.view(), of_run.view());
      BilateralNormalsParameters bilateral;
      bilateral.radius = 0.1;
      bilateral.merge_above = merge_above;
      const auto statistics = filterNormalsBilaterally(bilateral, named.cloud.points.view(), of_run.view());
      EXPECT_EQ(statistics.mean_change.size(), bilateral.iterations);
      EXPECT_EQ(statistics.isolated_points, 0u);
    }
    const auto all = toVectors(normals[0]), merged = toVectors(normals[1]);
    std::vector<double> angles(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      angles[i] = lineAngle(all[i], merged[i]);
    // Points beside an edge may take either face; the rest hardly differs.
    const double mean = std::accumulate(angles.begin(), angles.end(), 0.0) / static_cast<double>(angles.size());
    std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2), angles.end());
    EXPECT_GT(angles[angles.size() / 2], 0.0) << "nothing was merged";
    EXPECT_LT(angles[angles.size() / 2], 0.01) << "radians, median";
    EXPECT_LT(mean, 0.05) << "radians";
  }
}

} // namespace
} // namespace pcl_gpf::test
