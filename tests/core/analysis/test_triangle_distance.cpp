// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/triangle.h"

#include <pcl_gpf/core/analysis/surface_sampling.h>
#include <pcl_gpf/core/analysis/triangle_distance.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

namespace pcl_gpf {
namespace {

struct Mesh {
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
};

Position
randomPosition(SplitMix64& random, double half_width = 1)
{
  Position p;
  for (double& coordinate : p)
    coordinate = half_width * (2 * random.uniform() - 1);
  return p;
}

/** \brief Unit cube centred at 0, outward oriented. */
Mesh
cube()
{
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices.push_back((corner >> axis & 1) - 0.5);
  mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

/** \brief Unit sphere: an octahedron whose triangles were cut in four `levels` times. */
Mesh
sphere(int levels)
{
  Mesh mesh{{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
            {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto inserted = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size() / 3));
      if (inserted.second) {
        Position sum{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum[axis] = mesh.vertices[3 * a + axis] + mesh.vertices[3 * b + axis];
        sum = normalized(sum);
        mesh.vertices.insert(mesh.vertices.end(), sum.begin(), sum.end());
      }
      return inserted.first->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const std::uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/** \brief Distance to the cube by formula. */
double
signedCubeDistance(const Position& p)
{
  Position outside;
  double inside = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double q = std::abs(p[axis]) - 0.5;
    outside[axis] = std::max(q, 0.0);
    inside = std::max(inside, q);
  }
  return inside > 0 ? length(outside) : inside;
}

/** \brief Least distance over a fine grid of barycentric coordinates: an upper bound that is at most one step too large. */
double
gridDistance(const TriangleCorners& p, const Position& query, int steps)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const Position on = addScaled(addScaled(p[0], i / double(steps), subtract(p[1], p[0])), j / double(steps), subtract(p[2], p[0]));
      least = std::min(least, length(subtract(on, query)));
    }
  return least;
}

TEST(Triangle, nearestPointIsNeverBeatenByAGridOfPoints)
{
  SplitMix64 random(1);
  constexpr int kSteps = 60;
  for (int trial = 0; trial < 300; ++trial) {
    const TriangleCorners corners{randomPosition(random), randomPosition(random), randomPosition(random)};
    const Position query = randomPosition(random, 2);
    const double distance = std::sqrt(nearestOfTriangle(corners, query).distance_sq);
    const double grid = gridDistance(corners, query, kSteps);
    const double step = (length(subtract(corners[1], corners[0])) + length(subtract(corners[2], corners[0]))) / kSteps;
    EXPECT_LE(distance, grid + 1e-12);
    EXPECT_GE(distance, grid - step);
  }
}

TEST(Triangle, namesTheFeatureThatHoldsTheNearestPoint)
{
  const TriangleCorners corners{Position{0, 0, 0}, Position{4, 0, 0}, Position{0, 4, 0}};
  const auto feature = [&](double x, double y) { return nearestOfTriangle(corners, {x, y, 1}).feature; };
  EXPECT_EQ(feature(1, 1), TriangleFeature::Face);
  EXPECT_EQ(feature(2, -1), TriangleFeature::Edge0);
  EXPECT_EQ(feature(3, 3), TriangleFeature::Edge1);
  EXPECT_EQ(feature(-1, 2), TriangleFeature::Edge2);
  EXPECT_EQ(feature(-1, -1), TriangleFeature::Corner0);
  EXPECT_EQ(feature(6, -1), TriangleFeature::Corner1);
  EXPECT_EQ(feature(-1, 6), TriangleFeature::Corner2);
}

TEST(Triangle, doesNotDependOnTheOrderOfCornersAndMovesWithTheFrame)
{
  SplitMix64 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    TriangleCorners corners{randomPosition(random), randomPosition(random), randomPosition(random)};
    Position query = randomPosition(random);
    const double distance_sq = nearestOfTriangle(corners, query).distance_sq;
    EXPECT_NEAR(nearestOfTriangle({corners[1], corners[2], corners[0]}, query).distance_sq, distance_sq, 1e-12);
    EXPECT_NEAR(nearestOfTriangle({corners[1], corners[0], corners[2]}, query).distance_sq, distance_sq, 1e-12);
    for (Position* p : {&corners[0], &corners[1], &corners[2], &query})
      *p = {0x1p20 * (*p)[1], 0x1p20 * (*p)[2], 0x1p20 * (*p)[0]};
    EXPECT_NEAR(nearestOfTriangle(corners, query).distance_sq, distance_sq * 0x1p40, 1e-12 * 0x1p40);
  }
}

TEST(Triangle, withoutAreaIsASegmentOrAPoint)
{
  const Position a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
  EXPECT_DOUBLE_EQ(nearestOfTriangle({a, b, c}, {2, 2, 0}).distance_sq, 4.0);
  EXPECT_DOUBLE_EQ(nearestOfTriangle({a, c, b}, {5, 0, 0}).distance_sq, 4.0);
  EXPECT_DOUBLE_EQ(nearestOfTriangle({a, a, c}, {1, 0, 3}).distance_sq, 9.0);
  EXPECT_DOUBLE_EQ(nearestOfTriangle({b, b, b}, {1, 5, 0}).distance_sq, 25.0);
  // Collinear up to rounding: the direction of the normal is noise and must not be used.
  const TriangleCorners sliver{Position{0.1, 0.1, 0.1}, Position{0.3, 0.3, 0.3}, Position{0.7, 0.7, 0.7 + 1e-16}};
  EXPECT_NEAR(nearestOfTriangle(sliver, {0.3, 0.3, 1.2}).distance_sq, 0.09 + 0.09 + 0.36, 1e-12); // at 0.6 0.6 0.6
}

TEST(TriangleDistance, equalsTheNearestOfAllTriangles)
{
  SplitMix64 random(3);
  Mesh soup;
  for (std::uint32_t i = 0; i < 3 * 400; ++i) {
    const Position p = randomPosition(random);
    soup.vertices.insert(soup.vertices.end(), p.begin(), p.end());
    soup.triangles.push_back(i);
  }
  const TriangleDistance tree(soup.vertices, soup.triangles);
  for (int trial = 0; trial < 500; ++trial) {
    const Position query = randomPosition(random, 1.5);
    double least_sq = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < 400; ++t) {
      TriangleCorners corners;
      for (std::size_t k = 0; k < 9; ++k)
        corners[k / 3][k % 3] = soup.vertices[9 * t + k];
      least_sq = std::min(least_sq, nearestOfTriangle(corners, query).distance_sq);
    }
    const auto nearest = tree.nearest(query);
    EXPECT_DOUBLE_EQ(std::abs(nearest.signed_distance), std::sqrt(least_sq));
    EXPECT_NEAR(length(subtract(nearest.point, query)), std::sqrt(least_sq), 1e-14);
  }
}

TEST(TriangleDistance, ofACubeIsItsFormulaWithSign)
{
  const Mesh mesh = cube();
  const TriangleDistance tree(mesh.vertices, mesh.triangles);
  SplitMix64 random(4);
  for (int trial = 0; trial < 5000; ++trial) { // most of these lie beyond an edge or a corner
    const Position query = randomPosition(random, 1.5);
    EXPECT_NEAR(tree.nearest(query).signed_distance, signedCubeDistance(query), 1e-14);
  }
}

TEST(TriangleDistance, signIsRightBesideACornerWhereFacesDisagree)
{
  // A thin spike: near its tip the normal of a single face points the wrong way for half of the queries.
  Mesh spike{{0, 0, 10, 1, 0, 0, -1, 1, 0, -1, -1, 0}, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}};
  const TriangleDistance tree(spike.vertices, spike.triangles);
  SplitMix64 random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    Position query = randomPosition(random, 0.5);
    query[2] = 10.01 + std::abs(query[2]);
    EXPECT_GT(tree.nearest(query).signed_distance, 0.0);
  }
  EXPECT_LT(tree.nearest({0, 0, 9}).signed_distance, 0.0);
}

TEST(TriangleDistance, unweldedVerticesGiveTheSameSigns)
{
  const Mesh mesh = sphere(2);
  Mesh soup;
  for (const std::uint32_t vertex : mesh.triangles) {
    soup.triangles.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
    for (std::size_t axis = 0; axis < 3; ++axis)
      soup.vertices.push_back(mesh.vertices[3 * vertex + axis]);
  }
  const TriangleDistance welded(mesh.vertices, mesh.triangles), unwelded(soup.vertices, soup.triangles);
  SplitMix64 random(6);
  for (int trial = 0; trial < 1000; ++trial) {
    const Position query = randomPosition(random);
    EXPECT_EQ(welded.nearest(query).signed_distance, unwelded.nearest(query).signed_distance);
  }
}

TEST(TriangleDistance, ofAFineSphereConvergesToRadiusMinusOne)
{
  const Mesh mesh = sphere(6);
  const TriangleDistance tree(mesh.vertices, mesh.triangles);
  SplitMix64 random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const Position query = randomPosition(random);
    const double exact = length(query) - 1;
    const double sagitta = 4e-4; // of a chord of the longest edge, about 1.6 / 2^6 long
    EXPECT_GE(tree.nearest(query).signed_distance, exact - 1e-12);
    EXPECT_LE(tree.nearest(query).signed_distance, exact + sagitta);
  }
}

TEST(TriangleDistance, doesNotDependOnTheThreadsAndSkipsNaN)
{
  const Mesh mesh = sphere(3);
  const TriangleDistance tree(mesh.vertices, mesh.triangles);
  SplitMix64 random(8);
  std::vector<Position> queries;
  for (int i = 0; i < 3000; ++i)
    queries.push_back(randomPosition(random));
  const auto expected = tree.signedDistances(queries, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(tree.signedDistances(queries, threads), expected);
  EXPECT_TRUE(std::isnan(tree.signedDistances({{std::numeric_limits<double>::quiet_NaN(), 0, 0}})[0]));
}

TEST(TriangleDistance, refusesBrokenMeshes)
{
  EXPECT_THROW(TriangleDistance({0, 0, 0}, {}), UnsuitableData);
  EXPECT_THROW(TriangleDistance({0, 0, 0}, {0, 0, 1}), InvalidParameter);
  EXPECT_THROW(TriangleDistance({0, 0, 0}, {0, 0}), InvalidParameter);
  EXPECT_THROW(TriangleDistance({0, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 0, 0}), InvalidParameter);
}

TEST(SurfaceSampling, liesOnTheSurfaceWithEqualDensity)
{
  const Mesh mesh = cube();
  const TriangleDistance tree(mesh.vertices, mesh.triangles);
  const auto samples = sampleSurface(mesh.vertices, mesh.triangles, 60000, 9);
  std::array<int, 6> faces{};
  std::array<int, 2> halves{};
  for (const Position& sample : samples) {
    EXPECT_NEAR(tree.nearest(sample).signed_distance, 0.0, 1e-15);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(std::abs(sample[axis]) - 0.5) < 1e-12)
        ++faces[2 * axis + (sample[axis] > 0)];
    ++halves[sample[0] + sample[1] + sample[2] > 0];
  }
  for (const int face : faces)
    EXPECT_NEAR(face, 10000, 500); // five standard deviations
  EXPECT_NEAR(halves[0], 30000, 650);
  EXPECT_EQ(sampleSurface(mesh.vertices, mesh.triangles, 100, 9), sampleSurface(mesh.vertices, mesh.triangles, 100, 9));
  EXPECT_THROW(sampleSurface({0, 0, 0}, {0, 0, 0}, 1, 1), UnsuitableData);
}

} // namespace
} // namespace pcl_gpf
