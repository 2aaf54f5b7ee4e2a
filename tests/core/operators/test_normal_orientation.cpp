// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/core/operators/plane_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace pcl_gpf::test {
namespace {

using Viewpoint = std::array<double, 3>;

double
dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** \brief Turns about half of the normals round. */
std::vector<Vector3>
shuffledSigns(std::vector<Vector3> normals, std::uint64_t seed = 3)
{
  SplitMix64 random(seed);
  for (Vector3& normal : normals)
    if (random.below(2) == 1)
      normal = {-normal[0], -normal[1], -normal[2]};
  return normals;
}

struct Oriented {
  std::vector<Vector3> normals;
  NormalOrientationStatistics statistics;
};

Oriented
orient(const std::vector<Vector3>& points, const std::vector<Vector3>& normals,
       const NormalOrientationParameters& parameters = {}, const Viewpoint* viewpoint = nullptr)
{
  const SoaBuffer positions = toBuffer(points);
  SoaBuffer buffer = toBuffer(normals);
  Oriented result;
  result.statistics = orientNormals(parameters, positions.view(), buffer.view(), viewpoint);
  result.normals = toVectors(buffer);
  return result;
}

/** \brief The same with exact normals, whose signs are shuffled before. */
Oriented
orient(const Shape& shape, const NormalOrientationParameters& parameters = {}, const Viewpoint* viewpoint = nullptr)
{
  return orient(shape.points, shuffledSigns(shape.normals), parameters, viewpoint);
}

/** \brief Share of the normals that point against the exact ones. */
double
shareWrong(const std::vector<Vector3>& normals, const std::vector<Vector3>& exact)
{
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    wrong += dot(normals[i], exact[i]) < 0;
  return static_cast<double>(wrong) / static_cast<double>(normals.size());
}

/** \brief Share of the normals of a box [0, 1]^2 x [0, top] that point inward. Beside an edge a normal may be that of
 * either face, so that the face counts whose direction it has. */
double
shareInward(const std::vector<Vector3>& points, const std::vector<Vector3>& normals, double top)
{
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
      axis = std::fabs(normals[i][other]) > std::fabs(normals[i][axis]) ? other : axis;
    wrong += (points[i][axis] - (axis == 2 ? top / 2 : 0.5)) * normals[i][axis] < 0;
  }
  return static_cast<double>(wrong) / static_cast<double>(normals.size());
}

/** \brief Plane fits within `radius`, then the bilateral filter within `wide`, then shuffled signs. */
std::vector<Vector3>
filteredNormals(const std::vector<Vector3>& points, double radius, double wide)
{
  const SoaBuffer positions = toBuffer(points);
  SoaBuffer normals(points.size());
  PlaneNormalsParameters planes;
  planes.radius = radius;
  estimatePlaneNormals(planes, positions.view(), normals.view());
  BilateralNormalsParameters bilateral;
  bilateral.radius = wide;
  filterNormalsBilaterally(bilateral, positions.view(), normals.view());
  return shuffledSigns(toVectors(normals));
}

/** \brief Closed plate [0, 1]^2 x [0, top], rims included. */
Shape
plate(std::size_t count, double top, double noise)
{
  return sampleShape(count, noise, 5, [top](SplitMix64& random, Vector3& point, Vector3& normal) {
    const double at = random.uniform() * (2 + 4 * top);
    point = {random.uniform(), random.uniform(), random.uniform() * top};
    const std::size_t axis = at < 2 ? 2 : at < 2 + 2 * top ? 0 : 1;
    const double side = static_cast<double>(random.below(2));
    point[axis] = side * (axis == 2 ? top : 1.0);
    normal = {0, 0, 0};
    normal[axis] = 2 * side - 1;
  });
}

/** \brief Closed bracket: the cube without the quarter x > 1/2, z > 1/2; five convex edges and a concave one along y */
Shape
bracket(std::size_t count, double noise)
{
  return sampleShape(count, noise, 6, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    constexpr double kProfile[7][2] = {{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}, {0, 0}}; // x and z
    const double at = random.uniform() * 5.5;
    if (at < 4) {
      double along = at;
      std::size_t side = 0;
      const auto length = [&](std::size_t s) {
        return std::hypot(kProfile[s + 1][0] - kProfile[s][0], kProfile[s + 1][1] - kProfile[s][1]);
      };
      for (; along > length(side); ++side)
        along -= length(side);
      const double dx = (kProfile[side + 1][0] - kProfile[side][0]) / length(side);
      const double dz = (kProfile[side + 1][1] - kProfile[side][1]) / length(side);
      point = {kProfile[side][0] + along * dx, random.uniform(), kProfile[side][1] + along * dz};
      normal = {dz, 0, -dx};
      return;
    }
    do
      point = {random.uniform(), 0, random.uniform()};
    while (point[0] > 0.5 && point[2] > 0.5);
    point[1] = at < 4.75 ? 0 : 1;
    normal = {0, 2 * point[1] - 1, 0};
  });
}

TEST(NormalOrientation, NoisyCubeAndSphereAfterTheBilateralFilterPointOutward)
{
  const double noise = 0.01 * std::sqrt(3.0); // 1 % of the diagonal
  const Shape box = cube(20000, noise);
  const Oriented cube_result = orient(box.points, filteredNormals(box.points, 4 * noise, 8 * noise));
  EXPECT_LE(shareInward(box.points, cube_result.normals, 1), 1e-3);
  EXPECT_EQ(cube_result.statistics.parts, 1u);
  EXPECT_EQ(cube_result.statistics.parts_outward, 1u);
  EXPECT_NEAR(cube_result.statistics.noise, noise, 0.3 * noise);

  const Shape ball = sphere(20000, noise);
  const Oriented ball_result = orient(ball.points, filteredNormals(ball.points, 4 * noise, 8 * noise));
  EXPECT_LE(shareWrong(ball_result.normals, ball.normals), 1e-3);
}

TEST(NormalOrientation, ConcaveAndConvexEdgesOfANoisyBracket)
{
  for (const double noise : {0.0, 0.005, 0.015})
    EXPECT_LE(shareWrong(orient(bracket(20000, noise)).normals, bracket(20000, noise).normals), 1e-3) << noise;
}

TEST(NormalOrientation, BothSidesOfAThinPlatePointOutward)
{
  constexpr std::size_t kCount = 20000;
  const double spacing = std::sqrt(2.0 / kCount), top = 4 * spacing, noise = 0.0025 * std::sqrt(2.0);
  const Shape shape = plate(kCount, top, noise);
  const Oriented result = orient(shape.points, filteredNormals(shape.points, 3 * spacing, 3 * spacing));
  EXPECT_LE(shareInward(shape.points, result.normals, top), 2e-3);
  EXPECT_EQ(result.statistics.parts_outward, result.statistics.parts);
}

TEST(NormalOrientation, CreasesSharperThanARightAngleAreCrossedRightly)
{
  for (const double degrees : {60.0, 75.0, 90.0}) { // between the two faces, within the material
    const double half = degrees * std::acos(-1.0) / 360;
    const Shape roof = sampleShape(8000, 0, 8, [half](SplitMix64& random, Vector3& point, Vector3& normal) {
      const double side = random.below(2) == 1 ? 1 : -1, along = random.uniform();
      point = {side * along * std::sin(half), random.uniform(), -along * std::cos(half)};
      normal = {side * std::cos(half), 0, std::sin(half)};
    });
    EXPECT_LE(shareWrong(orient(roof).normals, roof.normals), 1e-3) << degrees;
  }
}

TEST(NormalOrientationLaws, OnlySignsChangeAndTheSignsOfTheInputDoNotMatter)
{
  const Shape shape = turned(cube(4000, 0.01));
  const std::vector<Vector3> mixed = shuffledSigns(shape.normals, 1), other = shuffledSigns(shape.normals, 2);
  const Oriented result = orient(shape.points, mixed), again = orient(shape.points, other);
  std::size_t flipped = 0;
  const std::vector<Vector3> rounded = toVectors(toBuffer(mixed));
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const bool turned_round = dot(result.normals[i], rounded[i]) < 0;
    flipped += turned_round;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(result.normals[i][axis], turned_round ? -rounded[i][axis] : rounded[i][axis]);
      EXPECT_EQ(result.normals[i][axis], again.normals[i][axis]);
    }
  }
  EXPECT_EQ(result.statistics.flipped, flipped);
  EXPECT_GT(flipped, 0u);
}

TEST(NormalOrientationLaws, SameSignsForAnyNumberOfThreads)
{
  const Shape shape = cube(30000, 0.01);
  NormalOrientationParameters parameters;
  parameters.number_of_threads = 1;
  const Oriented expected = orient(shape, parameters);
  for (const unsigned threads : {2u, 3u, 7u}) {
    parameters.number_of_threads = threads;
    const Oriented result = orient(shape, parameters);
    EXPECT_EQ(result.normals, expected.normals) << threads;
    EXPECT_EQ(result.statistics.disagreeing_votes, expected.statistics.disagreeing_votes);
    EXPECT_EQ(result.statistics.noise, expected.statistics.noise);
  }
}

TEST(NormalOrientationLaws, RotationAndScaleCommute)
{
  const Shape shape = cube(4000, 0.01);
  EXPECT_EQ(shareInward(shape.points, orient(shape).normals, 1), 0);
  for (const double scale : {1e-4, 1.0, 1e4}) {
    Shape moved = turned(shape);
    for (Vector3& point : moved.points)
      for (double& coordinate : point)
        coordinate *= scale;
    EXPECT_LE(shareWrong(orient(moved).normals, moved.normals), 1e-3) << scale;
  }
}

TEST(NormalOrientationLaws, VotesAreThoseOfTheFormula)
{
  const Shape shape = turned(cube(600, 0.01));
  const std::vector<Vector3> p = toVectors(toBuffer(shape.points));
  NormalOrientationParameters parameters;
  parameters.neighbors = 12;
  parameters.noise = 0.01;
  const Oriented result = orient(shape, parameters);
  std::size_t disagreeing = 0, undecided = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t j = 0; j < p.size(); ++j)
      if (j != i)
        order.emplace_back(distance(p[i], p[j]), j);
    std::sort(order.begin(), order.end());
    const double spacing_sq = order[11].first * order[11].first * std::acos(-1.0) / 12;
    for (std::size_t e = 0; e < 12; ++e) {
      const Vector3 &a = result.normals[i], &b = result.normals[order[e].second], &q = p[order[e].second];
      const Vector3 d{q[0] - p[i][0], q[1] - p[i][1], q[2] - p[i][2]};
      const double length_sq = dot(d, d), twice = 2 * dot(a, b) * dot(a, b) - 1;
      const double relative = (8 * 0.01 * 0.01 + 2 * spacing_sq * twice * twice) / length_sq;
      const double vote = dot(a, b) - 2 * dot(a, d) * dot(b, d) / length_sq / (1 + relative * relative);
      undecided += std::fabs(vote * 1024) < 0.51;
      disagreeing += vote * 1024 <= -0.51;
    }
  }
  EXPECT_EQ(result.statistics.votes, 12u * p.size());
  EXPECT_GT(disagreeing, 0u);
  EXPECT_NEAR(static_cast<double>(result.statistics.disagreeing_votes), static_cast<double>(disagreeing),
              static_cast<double>(undecided));
  EXPECT_LT(undecided, disagreeing / 4);
}

TEST(NormalOrientationSides, OpenPartsFaceTheViewpointOrLookUp)
{
  const Shape square = turned(plane(2000, 0.002));
  const Vector3 above = square.normals[0], below{-above[0], -above[1], -above[2]};
  const Oriented by_root = orient(square);
  EXPECT_GT(by_root.normals[0][2], 0);
  EXPECT_EQ(by_root.statistics.parts_by_root, 1u);
  for (const Vector3& from : {above, below}) {
    const Oriented result = orient(square, {}, &from);
    EXPECT_EQ(shareWrong(result.normals, std::vector<Vector3>(square.size(), from)), 0);
    EXPECT_EQ(result.statistics.parts_by_viewpoint, 1u);
  }
}

TEST(NormalOrientationSides, ClosedPartsPointOutwardUnlessSeenFromWithin)
{
  const Shape ball = sphere(3000);
  const Viewpoint within{0.1, 0, 0.1}, without{5, 1, 2};
  EXPECT_EQ(shareWrong(orient(ball).normals, ball.normals), 0);
  const Oriented from_without = orient(ball, {}, &without);
  EXPECT_EQ(shareWrong(from_without.normals, ball.normals), 0);
  EXPECT_EQ(from_without.statistics.parts_outward, 1u);
  EXPECT_EQ(shareWrong(orient(ball, {}, &within).normals, ball.normals), 1);
}

TEST(NormalOrientationSides, EachPartGetsItsOwnSide)
{
  Shape shapes = sphere(2000);
  for (const Vector3& offset : {Vector3{3, 0, 0}, Vector3{0, -4, 1}}) {
    const Shape more = sphere(2000, 0, 17);
    for (std::size_t i = 0; i < more.size(); ++i)
      append(shapes, {more.points[i][0] + offset[0], more.points[i][1] + offset[1], more.points[i][2] + offset[2]},
             more.normals[i]);
  }
  const Oriented result = orient(shapes);
  EXPECT_EQ(result.statistics.parts, 3u);
  EXPECT_EQ(result.statistics.parts_outward, 3u);
  EXPECT_EQ(shareWrong(result.normals, shapes.normals), 0);
}

TEST(NormalOrientationSides, NearPartsAreJoinedAcrossTheirGap)
{
  // A tilted square whose middle is missing; alone, each half would look up.
  const Shape whole = turned(turned(plane(4000)));
  const Shape flat = plane(4000);
  Shape halves;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (std::fabs(flat.points[i][0] - 0.5) > 2.0 / std::sqrt(4000.0))
      append(halves, whole.points[i], whole.normals[i]);
  NormalOrientationParameters parameters;
  parameters.gap = 0;
  EXPECT_EQ(orient(halves, parameters).statistics.parts, 2u);
  parameters.gap = 6;
  const Oriented joined = orient(halves, parameters);
  EXPECT_EQ(joined.statistics.parts, 1u);
  const double wrong = shareWrong(joined.normals, halves.normals);
  EXPECT_TRUE(wrong == 0 || wrong == 1);
}

TEST(NormalOrientationHostile, FewAndCoincidentPoints)
{
  EXPECT_EQ(orient(Shape()).statistics.votes, 0u);
  for (const std::size_t count : {1u, 2u, 3u, 4u}) {
    const Oriented result = orient(cube(count));
    EXPECT_EQ(result.normals.size(), count);
    EXPECT_EQ(result.statistics.votes, count * (count - 1));
  }
  const std::vector<Vector3> same(100, Vector3{0.25, 0.5, 0.75}), up(100, Vector3{0, 0, 1});
  const Oriented pile = orient(same, shuffledSigns(up));
  EXPECT_EQ(shareWrong(pile.normals, up), 0);

  Shape piles = cube(2000); // each point forty times: no neighbour is elsewhere, gaps of 0 spacings
  Shape copies;
  for (std::size_t i = 0; i < 50; ++i)
    for (int copy = 0; copy < 40; ++copy)
      append(copies, piles.points[i], piles.normals[i]);
  EXPECT_EQ(orient(copies).statistics.parts, 50u);
}

TEST(NormalOrientationHostile, FarFromTheOriginAndFarOutliers)
{
  Shape shape = cube(4000);
  append(shape, {1e6, -1e6, 1e6}, {0, 0, 1});
  const Oriented result = orient(shape);
  EXPECT_LE(shareWrong(result.normals, shape.normals), 1e-3);
}

TEST(NormalOrientationParameters, OutOfRangeThrowsAndCancelThrows)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(NormalOrientationParameters&)> mistakes[] = {
      [](auto& p) { p.neighbors = 2; }, [](auto& p) { p.neighbors = 101; }, [](auto& p) { p.noise = -1; },
      [&](auto& p) { p.noise = nan; },  [](auto& p) { p.gap = -1; },        [](auto& p) { p.gap = 101; }};
  for (const auto& mistake : mistakes) {
    NormalOrientationParameters parameters;
    mistake(parameters);
    EXPECT_THROW(orient(cube(100), parameters), InvalidParameter) << &mistake - mistakes;
  }
  const SoaBuffer points = toBuffer(cube(500).points);
  SoaBuffer normals = toBuffer(cube(500).normals);
  const std::vector<Vector3> before = toVectors(normals);
  EXPECT_THROW(orientNormals({}, points.view(), normals.view(), nullptr, [](double done) { return done < 0.5; }),
               Cancelled);
  EXPECT_EQ(toVectors(normals), before);
}

} // namespace
} // namespace pcl_gpf::test
