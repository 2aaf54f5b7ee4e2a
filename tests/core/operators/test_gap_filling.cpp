// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_run.h"

#include "support/edge_band.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/gap_filling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr double kRootThree = 1.73205080756887729353; // diagonal of the unit cube

/** The paper's weights with sigma fixed: whatever is within h / 2 of an edge is drawn onto it. */
GPFParameters
attracting(double support_radius)
{
  GPFParameters p;
  p.support_radius = support_radius;
  p.data_term = DataTerm::PointToPlane;
  p.normal_angle = 90.0;
  p.normal_weight_floor = 1.0;
  p.maximum_iterations = 15;
  p.convergence_threshold = 0.0;
  return p;
}

struct Filtered {
  std::vector<Vector3> points, normals;
  std::vector<IterationStats> rounds;
};

Filtered
filter(const GPFParameters& p, const GPFInput& input)
{
  GPFState state = gpfInit(p, input);
  gpfRun(state);
  Filtered result;
  result.rounds = gpfFillGaps(state);
  result.points = toVectors(positionsOf(state));
  SoaBuffer normals(state.size());
  state.normals(normals.view());
  result.normals = toVectors(normals);
  return result;
}

/** A cube in the frame in which its diagonal is 1, its first corner at the origin; noise in units of the side. */
LocalCloud
cubeOfDiagonalOne(std::size_t count, double noise)
{
  const Shape shape = cube(count, noise, 1);
  LocalCloud cloud;
  cloud.points = toBuffer(shape.points);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    cloud.points.x[i] /= static_cast<float>(kRootThree);
    cloud.points.y[i] /= static_cast<float>(kRootThree);
    cloud.points.z[i] /= static_cast<float>(kRootThree);
  }
  cloud.normals = toBuffer(shape.normals);
  cloud.v = toVectors(cloud.points);
  cloud.b = toVectors(cloud.normals);
  return cloud;
}

double
meanDistanceToCube(const std::vector<Vector3>& points)
{
  double sum = 0;
  for (const Vector3& p : points)
    sum += distanceToUnitCube(p);
  return sum / static_cast<double>(points.size());
}

SoaBuffer
moves(const Shape& shape, double radius, double spacing, unsigned threads = 0)
{
  GapFillingParameters p;
  p.radius = radius;
  p.spacing = spacing;
  p.number_of_threads = threads;
  return movesIntoGaps(p, toBuffer(shape.points).view(), toBuffer(shape.normals).view());
}

std::size_t
countMoved(const SoaBuffer& buffer)
{
  const auto all = toVectors(buffer);
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const Vector3& m) { return distance(m, {0, 0, 0}) > 0; }));
}

/** The edge of shapes.h, of which one point lies in each cell of a grid. */
Shape
evenEdge(std::size_t side)
{
  std::size_t i = 0;
  return sampleShape(2 * side * side, 0, 3, [side, i](SplitMix64& random, Vector3& point, Vector3& normal) mutable {
    const bool upright = i >= side * side;
    const double across = (static_cast<double>(i % side) + random.uniform()) / static_cast<double>(side);
    const double along = (static_cast<double>(i / side % side) + random.uniform()) / static_cast<double>(side);
    point = {upright ? 0 : across, along, upright ? -across : 0};
    normal = {upright ? -1.0 : 0.0, 0, upright ? 0.0 : 1.0};
    ++i;
  });
}

/** Puts all points within `band` of the edge onto it. */
Shape
collapsed(Shape shape, double band)
{
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const std::size_t across = shape.normals[i][0] != 0 ? 2 : 0;
    double& d = shape.points[i][across];
    if (std::abs(d) < band)
      d *= 0.01;
  }
  return shape;
}

TEST(GapFilling, fillsTheBandBesideTheEdgesOfACube)
{
  for (const double noise : {0.009, 0.017}) { // 0.5 and 1 % of the diagonal
    SCOPED_TRACE(noise);
    const LocalCloud cloud = cubeOfDiagonalOne(12000, noise);
    const auto toCube = [](Filtered result) {
      for (Vector3& p : result.points)
        for (double& c : p)
          c *= kRootThree;
      return result;
    };
    GPFParameters p = attracting(0.11);
    const Filtered before = toCube(filter(p, inputOf(cloud)));
    p.gap_iterations = 2;
    const Filtered after = toCube(filter(p, inputOf(cloud)));
    EXPECT_TRUE(before.rounds.empty());
    EXPECT_EQ(after.rounds.size(), 2u);
    EXPECT_GE(cubeBand(before.points, before.normals), 2.5);
    EXPECT_LE(cubeBand(after.points, after.normals), 1.5);
    EXPECT_LE(meanDistanceToCube(after.points), 1.05 * meanDistanceToCube(before.points));
  }
}

TEST(GapFilling, givesCollapsedPointsTheirPlacesBack)
{
  constexpr double kSpacing = 1.0 / 55;
  const Shape even = evenEdge(55), shape = collapsed(even, 0.1);
  const auto move = toVectors(moves(shape, 0.25, kSpacing));
  // Everywhere along the edge the k-th point from it ends up where the k-th of the even points is, less what stays on the edge.
  for (const bool upright : {false, true})
    for (double y = 0.1; y < 0.9; y += 0.1) {
      std::vector<double> wanted, found;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        if (std::abs(shape.points[i][1] - y) > 0.05 || (shape.normals[i][0] != 0) != upright)
          continue;
        const std::size_t across = upright ? 2 : 0;
        wanted.push_back(std::abs(even.points[i][across]));
        found.push_back(std::abs(shape.points[i][across] + move[i][across]));
      }
      std::sort(wanted.begin(), wanted.end());
      std::sort(found.begin(), found.end());
      for (std::size_t k = 0; k < wanted.size(); ++k)
        ASSERT_NEAR(found[k], wanted[k], 2 * kSpacing) << "point " << k << " at " << y;
    }
}

TEST(GapFilling, movesAwayFromTheEdgeWithinTheFaceOnly)
{
  const Shape shape = collapsed(edge(4000, 0, 3), 0.08);
  const SoaBuffer found = moves(shape, 0.2, 0.0224);
  EXPECT_GT(countMoved(found), 100u);
  const auto all = toVectors(found);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool upright = shape.normals[i][0] != 0;
    ASSERT_EQ(upright ? all[i][0] : all[i][2], 0.0) << "left its plane";
    ASSERT_GE(upright ? -all[i][2] : all[i][0], 0.0) << "towards the edge";
    ASSERT_LE(distance(all[i], {0, 0, 0}), 0.2);
    ASSERT_LE(std::abs(all[i][1]), 0.01) << "along the edge";
  }
}

/** A plate without its quarter x, y > 1/2, with walls down from the edges of that quarter; those edges have collected all that was within 0.08. */
TEST(GapFilling, doesNotCrossTheEdgeWhereTheFaceGoesRoundACorner)
{
  Shape shape;
  SplitMix64 random(7);
  for (std::size_t i = 0; i < 8000; ++i) {
    Vector3 p{random.uniform(), random.uniform(), 0}, n{0, 0, 1};
    if (p[0] > 0.5 && p[1] > 0.5) { // onto one of the walls
      const std::size_t across = random.below(2);
      p[2] = -(p[across] - 0.5);
      p[across] = 0.5;
      n = {0, 0, 0};
      n[across] = 1;
    } else if (p[0] > 0.5 && p[1] > 0.42)
      p[1] = 0.5 - 0.01 * (0.5 - p[1]);
    else if (p[1] > 0.5 && p[0] > 0.42)
      p[0] = 0.5 - 0.01 * (0.5 - p[0]);
    append(shape, p, n);
  }
  const SoaBuffer found = moves(shape, 0.2, 0.0125);
  EXPECT_GT(countMoved(found), 500u);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double x = shape.points[i][0] + found.x[i], y = shape.points[i][1] + found.y[i];
    ASSERT_FALSE(x > 0.5 + 0.0125 && y > 0.5 + 0.0125) << x << " " << y;
  }
}

TEST(GapFilling, leavesEvenPointsBordersAndSmoothSurfaces)
{
  EXPECT_EQ(countMoved(moves(plane(3000), 0.2, 0.018)), 0u);
  EXPECT_EQ(countMoved(moves(sphere(4000), 0.12, 0.028)), 0u);
  const Shape even = edge(6000, 0, 3);
  const SoaBuffer few = moves(even, 0.25, 0.0183);
  EXPECT_LT(countMoved(few), even.size() / 10);
  const LocalCloud cloud = toLocalCloud(turned(plane(3000)));
  GPFParameters p = attracting(0.15);
  const auto before = filter(p, inputOf(cloud));
  p.gap_iterations = 3;
  const auto after = filter(p, inputOf(cloud));
  EXPECT_EQ(after.points, before.points);
  EXPECT_EQ(after.rounds.size(), 1u) << "nothing was left to fill";
}

TEST(GapFilling, givesTheSameBitsForAnyNumberOfThreadsAndAboutTheSameWithAForeignSearch)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(3000, 0.01, 1)));
  const auto samples = everySecond(cloud.size());
  GPFParameters paper = GPFParameters::paper(), single = attracting(0.15);
  paper.maximum_iterations = 2;
  paper.support_radius = 0.15;
  for (GPFParameters p : {single, paper}) {
    p.gap_iterations = 2;
    p.number_of_threads = 1;
    const auto expected = filter(p, inputOf(cloud, &samples));
    p.number_of_threads = 3;
    const auto found = filter(p, inputOf(cloud, &samples));
    EXPECT_EQ(found.points, expected.points);
    EXPECT_EQ(found.normals, expected.normals);
  }
  single.maximum_iterations = 3;
  const Filtered start = filter(single, inputOf(cloud));
  single.gap_iterations = 1;
  const Filtered built_in = filter(single, inputOf(cloud)), foreign = filter(single, inputOf(cloud, nullptr, bruteForceSearch));
  std::size_t apart = 0; // rounding decides which of two neighbours on the edge comes first
  for (std::size_t m = 0; m < built_in.points.size(); ++m)
    apart += distance(built_in.points[m], foreign.points[m]) > 0.01;
  EXPECT_LT(apart, built_in.points.size() / 10);
  EXPECT_NE(start.points, built_in.points);
}

TEST(GapFilling, doesNotMindSignsOfNormals)
{
  Shape shape = collapsed(edge(2000, 0, 3), 0.1);
  const SoaBuffer expected = moves(shape, 0.25, 0.032);
  SplitMix64 random(5);
  for (Vector3& n : shape.normals)
    if (random.below(2) == 1)
      n = {-n[0], -n[1], -n[2]};
  const auto wanted = toVectors(expected), found = toVectors(moves(shape, 0.25, 0.032));
  for (std::size_t i = 0; i < wanted.size(); ++i)
    ASSERT_LE(distance(found[i], wanted[i]), 1e-5);
}

TEST(GapFilling, worksOnNextToNothing)
{
  for (std::size_t count = 0; count <= 3; ++count)
    EXPECT_EQ(countMoved(moves(edge(count, 0, 1), 0.2, 0.1)), 0u);
  Shape repeated = collapsed(edge(500, 0, 3), 0.1); // every point thrice
  for (std::size_t i = 0; i < 1000; ++i)
    append(repeated, repeated.points[i % 500], repeated.normals[i % 500]);
  for (const Vector3& m : toVectors(moves(repeated, 0.3, 0.06)))
    ASSERT_LE(distance(m, {0, 0, 0}), 0.3);
  Shape one_place;
  for (int i = 0; i < 40; ++i)
    append(one_place, {0.1, 0.2, 0.3}, {i % 2 == 0 ? 1.0 : 0.0, 0, i % 2 == 0 ? 0.0 : 1.0});
  EXPECT_EQ(countMoved(moves(one_place, 0.2, 0.01)), 0u);
  Shape no_direction = collapsed(edge(300, 0, 3), 0.1);
  for (std::size_t i = 0; i < 300; i += 3)
    no_direction.normals[i] = {0, 0, 0};
  const auto found = toVectors(moves(no_direction, 0.3, 0.08));
  for (std::size_t i = 0; i < 300; ++i)
    ASSERT_TRUE(distance(found[i], {0, 0, 0}) <= (i % 3 == 0 ? 0.0 : 0.3)) << i;
  GPFParameters p = attracting(0.2);
  p.gap_iterations = 2;
  const LocalCloud three = toLocalCloud(edge(3, 0, 1));
  EXPECT_EQ(filter(p, inputOf(three)).points.size(), 3u);
}

TEST(GapFilling, refusesParametersOutsideTheirRange)
{
  const SoaBuffer none(0);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    GapFillingParameters p;
    p.radius = bad;
    p.spacing = 0.1;
    EXPECT_THROW(movesIntoGaps(p, none.view(), none.view()), InvalidParameter);
    p.radius = 0.1;
    p.spacing = bad;
    EXPECT_THROW(movesIntoGaps(p, none.view(), none.view()), InvalidParameter);
    p.spacing = 0.1;
    p.angle = bad;
    EXPECT_THROW(movesIntoGaps(p, none.view(), none.view()), InvalidParameter);
  }
  GPFParameters p;
  p.gap_iterations = 101;
  EXPECT_THROW(validate(p), InvalidParameter);
  p.gap_iterations = 1;
  p.gap_radius_factor = 0.9;
  EXPECT_THROW(validate(p), InvalidParameter);
}

TEST(GapFilling, canBeCancelled)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(500, 0.01, 1)));
  GPFParameters p = attracting(0.2);
  p.maximum_iterations = 2;
  p.gap_iterations = 1;
  GPFState state = gpfInit(p, inputOf(cloud));
  gpfRun(state);
  EXPECT_THROW(gpfFillGaps(state, [](double) { return false; }), Cancelled);
  std::vector<double> fractions;
  gpfFillGaps(state, [&](double fraction) { fractions.push_back(fraction); return true; });
  EXPECT_EQ(fractions, (std::vector<double>{0.0, 1.0}));
}

} // namespace
} // namespace pcl_gpf::test
