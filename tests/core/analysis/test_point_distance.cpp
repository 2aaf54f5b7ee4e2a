// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/point_distance.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pcl_gpf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<Position>
randomPoints(std::size_t count, std::uint64_t seed, const Position& origin = {0, 0, 0})
{
  SplitMix64 random(seed);
  std::vector<Position> points(count);
  for (Position& point : points)
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = origin[axis] + random.uniform();
  return points;
}

double
bruteForce(const std::vector<Position>& points, const Position& query)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Position& point : points)
    if (isMeasurable(point))
      least = std::min(least, length(subtract(point, query)));
  return least;
}

TEST(PointDistance, equalsBruteForceInsideAndOutsideTheCloud)
{
  for (const std::size_t count : {1u, 2u, 7u, 8u, 9u, 100u, 3000u}) {
    const auto points = randomPoints(count, 1);
    const PointDistance tree(points);
    for (Position query : randomPoints(500, 2)) {
      query = addScaled({-1, -1, -1}, 3.0, query);
      const auto nearest = tree.nearest(query);
      EXPECT_EQ(nearest.distance, bruteForce(points, query));
      EXPECT_EQ(nearest.distance, length(subtract(points[nearest.index], query)));
    }
  }
}

TEST(PointDistance, keepsMillimetresOfUtmCoordinates)
{
  const Position utm{500000, 5500000, 100};
  const auto points = randomPoints(1000, 3, utm);
  const PointDistance tree(points);
  for (const Position& query : randomPoints(200, 4, utm))
    EXPECT_EQ(tree.nearest(query).distance, bruteForce(points, query));
}

TEST(PointDistance, leavesOutRowsThatAreNotFinite)
{
  auto points = randomPoints(50, 5);
  points[0] = {kNaN, 0, 0};
  points[17] = {0.5, std::numeric_limits<double>::infinity(), 0.5};
  points[49] = {1e300, 0, 0};
  const PointDistance tree(points);
  auto queries = randomPoints(20, 6);
  queries[3] = {0, kNaN, 0};
  const auto distances = tree.distances(queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (i == 3) {
      EXPECT_TRUE(std::isnan(distances[i]));
    } else {
      EXPECT_EQ(distances[i], bruteForce(points, queries[i]));
    }
  }
  EXPECT_EQ(tree.nearest(points[1]).index, 1u);
}

TEST(PointDistance, coincidentPointsCostNoMoreThanOthers)
{
  const std::vector<Position> points(200000, Position{1, 2, 3});
  const PointDistance tree(points);
  const std::vector<Position> queries(20000, Position{1, 2, 4}); // a linear search in each would take minutes
  for (const double distance : tree.distances(queries))
    ASSERT_EQ(distance, 1.0);
}

TEST(PointDistance, doesNotDependOnTheThreads)
{
  const PointDistance tree(randomPoints(5000, 7));
  const auto queries = randomPoints(4000, 8);
  const auto expected = tree.distances(queries, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(tree.distances(queries, threads), expected);
}

TEST(PointDistance, refusesACloudWithoutAFinitePoint)
{
  EXPECT_THROW(PointDistance({}), UnsuitableData);
  EXPECT_THROW(PointDistance({{kNaN, 0, 0}}), UnsuitableData);
}

} // namespace
} // namespace pcl_gpf
