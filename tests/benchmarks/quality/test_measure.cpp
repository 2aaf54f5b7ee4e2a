// SPDX-License-Identifier: BSD-3-Clause
#include "measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::quality {
namespace {

constexpr std::size_t kCount = 3000;
const double kCubeUnit = 1e4 / std::sqrt(3); ///< of the unit cube

MethodResult
keep(const NoisyCloud& cloud)
{
  return makeMethod("input").variants.front().run(cloud, 1);
}

MeasureOptions
quick()
{
  MeasureOptions options;
  options.references = 3000;
  return options;
}

NoisyCloud
cloudOf(const char* model, double percent, double outliers = 0)
{
  return makeNoisyCloud(makeModel(model, kCount), kCount, {NoiseKind::Gaussian, percent, outliers, 3});
}

/** Distance to the unit cube's surface, its sign, and the distance to its edges, written out. */
double
cubeDistance(const Position& p)
{
  double outside = 0, depth = 1;
  for (const double c : p) {
    const double beyond = std::max({-c, c - 1, 0.0});
    outside += beyond * beyond;
    depth = std::min({depth, c, 1 - c});
  }
  return outside > 0 ? std::sqrt(outside) : -depth;
}
double
cubeEdgeDistance(const Position& p)
{
  double least = 1e9;
  for (std::size_t a = 0; a < 3; ++a)
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0}) {
        const double along = p[a] - std::min(std::max(p[a], 0.0), 1.0);
        least = std::min(least, std::hypot(along, p[(a + 1) % 3] - u, p[(a + 2) % 3] - v));
      }
  return least;
}
double
nearestDistance(const std::vector<Position>& points, const Position& q)
{
  double least = 1e9;
  for (const Position& p : points)
    least = std::min(least, length(subtract(p, q)));
  return least;
}

/** Every figure of a noisy cube against a literal evaluation of its definition. */
TEST(Measure, EqualsTheDefinitions)
{
  const NoisyCloud cloud = cloudOf("cube", 2);
  const Figures f = measure(cloud, keep(cloud), quick());

  double sum = 0, squares = 0, signed_sum = 0, largest = 0, edge_sum = 0, edge_count = 0;
  std::vector<double> distances;
  for (const Position& p : cloud.points) {
    const double d = cubeDistance(p) * kCubeUnit;
    distances.push_back(std::abs(d));
    sum += std::abs(d) / kCount;
    signed_sum += d / kCount;
    squares += d * d / kCount;
    largest = std::max(largest, std::abs(d));
    if (cubeEdgeDistance(p) < 0.02 * std::sqrt(3)) {
      edge_sum += std::abs(d);
      ++edge_count;
    }
  }
  std::sort(distances.begin(), distances.end());
  const double rank = 0.95 * (kCount - 1);
  const auto below = static_cast<std::size_t>(rank);
  EXPECT_NEAR(f.mean, sum, 1e-8);
  EXPECT_NEAR(f.signed_mean, signed_sum, 1e-8);
  EXPECT_NEAR(f.rms, std::sqrt(squares), 1e-8);
  EXPECT_NEAR(f.mean_square, 1e-8 * squares, 1e-15);
  EXPECT_NEAR(f.max, largest, 1e-8);
  EXPECT_NEAR(f.p95, distances[below] + (rank - static_cast<double>(below)) * (distances[below + 1] - distances[below]),
              1e-8);
  EXPECT_NEAR(f.edge_mean, edge_sum / edge_count, 1e-8);
  EXPECT_NEAR(f.edge_share, edge_count / kCount, 1e-12);
  EXPECT_EQ(f.mean, f.mean_all);
  EXPECT_EQ(f.mean, f.mean_inliers);

  double edge_coverage = 0, coverage = 0;
  const std::vector<Position> edge = cloud.model.surface->edgeSamples(1e-3 * std::sqrt(3));
  for (std::size_t i = 0; i < edge.size(); ++i)
    edge_coverage += nearestDistance(cloud.points, edge[i]) / static_cast<double>(edge.size());
  EXPECT_NEAR(f.edge_coverage, edge_coverage * kCubeUnit, 1e-8);
  const std::vector<SurfaceSample> references = cloud.model.surface->sample(3000, 12345);
  for (const SurfaceSample& s : references)
    coverage += nearestDistance(cloud.points, s.point) / static_cast<double>(references.size());
  EXPECT_NEAR(f.coverage, coverage * kCubeUnit, 1e-8);
}

/** Beyond an edge two faces are equally near, and the normal of either counts: the figure lies between the extremes. */
TEST(Measure, NormalErrorsAreThoseOfTheNearestFace)
{
  const NoisyCloud cloud = cloudOf("cube", 2);
  MethodResult result = keep(cloud);
  double least = 0, most = 0;
  for (const Position& p : cloud.points) {
    const double i = static_cast<double>(result.normals.size());
    result.normals.push_back({std::cos(0.001 * i), -2 * std::sin(0.001 * i), 0.5});
    const Position n = normalized(result.normals.back());
    double nearest = 1e9, smallest = 0, largest = 0;
    for (std::size_t face = 0; face < 6; ++face) {
      Position on_face = p;
      for (double& c : on_face)
        c = std::min(std::max(c, 0.0), 1.0);
      on_face[face / 2] = static_cast<double>(face % 2);
      const double d = length(subtract(on_face, p)),
                   turn = std::acos(std::min(std::abs(n[face / 2]), 1.0)) * 180 / std::acos(-1);
      constexpr double kRounding = 1e-12;
      if (d > nearest + kRounding)
        continue;
      smallest = d < nearest - kRounding ? turn : std::min(smallest, turn);
      largest = d < nearest - kRounding ? turn : std::max(largest, turn);
      nearest = std::min(nearest, d);
    }
    least += smallest / kCount;
    most += largest / kCount;
  }
  const Figures f = measure(cloud, result, quick());
  EXPECT_GE(f.normal_error, least - 1e-9);
  EXPECT_LE(f.normal_error, most + 1e-9);
  EXPECT_LT(most - least, 3) << "or the bounds say little";
}

TEST(Measure, NormalsOfAnySignAndLengthCountNearEdgesToo)
{
  const NoisyCloud cloud = cloudOf("cube", 0);
  MethodResult result = keep(cloud);
  for (const SurfaceSample& s : cloud.clean) {
    const bool edge = cubeEdgeDistance(s.point) < 0.02 * std::sqrt(3);
    result.normals.push_back(edge ? Position{-3, -3, -3}
                                  : Position{-2 * s.normal[0], -2 * s.normal[1], -2 * s.normal[2]});
  }
  const Figures f = measure(cloud, result, quick());
  const double diagonal_angle = std::acos(1 / std::sqrt(3)) * 180 / std::acos(-1);
  EXPECT_NEAR(f.normal_error_edge, diagonal_angle, 1e-6);
  EXPECT_NEAR(f.normal_error, diagonal_angle * f.edge_share, 1e-5);
}

TEST(Measure, CleanPointsHaveNoError)
{
  for (const char* model : {"cube", "torus", "relief"}) {
    const NoisyCloud cloud = cloudOf(model, 0);
    const Figures f = measure(cloud, keep(cloud), quick());
    EXPECT_LT(f.max, 1e-9);
    EXPECT_EQ(f.movement, 0);
    EXPECT_GT(f.coverage, 0);
  }
}

/** An inflated sphere: every distance is the same and outside. */
TEST(Measure, InflationIsPositive)
{
  const NoisyCloud cloud = cloudOf("sphere", 0);
  MethodResult result = keep(cloud);
  for (Position& p : result.points)
    p = addScaled(p, 0.01, p);
  const Figures f = measure(cloud, result, quick());
  EXPECT_NEAR(f.signed_mean, 0.01 * 1e4 / std::sqrt(12), 1e-8);
  EXPECT_NEAR(f.mean, f.signed_mean, 1e-8);
  EXPECT_NEAR(f.movement, 0.01 / cloud.spacing, 1e-10);
  EXPECT_NEAR(f.movement_away, f.movement, 1e-12);
  EXPECT_TRUE(std::isnan(f.edge_mean) && std::isnan(f.edge_coverage) && std::isnan(f.recession) &&
              std::isnan(f.wrong_sheet));
}

TEST(Measure, FarOutliersAreLeftOutOfTheMeanOnly)
{
  const NoisyCloud cloud = cloudOf("cube", 0, 0.1);
  const Figures f = measure(cloud, keep(cloud), quick());
  double all = 0, near = 0;
  for (const Position& p : cloud.points) {
    const double d = std::abs(cubeDistance(p));
    all += d * kCubeUnit / kCount;
    near += d < 0.02 * std::sqrt(3) ? 1 : 0;
  }
  EXPECT_NEAR(f.mean_all, all, 1e-8);
  EXPECT_LT(f.mean_inliers, 1e-9);
  EXPECT_LE(f.max, 200) << "outliers within 2 % of the diagonal count";
  EXPECT_GT(f.mean, 0);
  EXPECT_LT(f.mean, 200 * (near - 2700) / near);
}

TEST(Measure, PointsThatAreNotFiniteAreCountedAndLeftOut)
{
  const NoisyCloud cloud = cloudOf("cube", 0);
  MethodResult result = keep(cloud);
  result.points[4][1] = std::nan("");
  const Figures f = measure(cloud, result, quick());
  EXPECT_EQ(f.not_finite, 1);
  EXPECT_LT(f.max, 1e-9);
}

TEST(Measure, NoPointsHaveNoFigures)
{
  const Figures f = measure(cloudOf("cube", 0), {}, quick());
  EXPECT_EQ(f.points, 0);
  EXPECT_TRUE(std::isnan(f.mean) && std::isnan(f.coverage));
}

/** A patch scaled about its centre recedes by what is missing at its sides, and by more at its corners. */
TEST(Measure, RecessionIsInSpacings)
{
  for (const char* model : {"plane", "sheets"}) {
    const NoisyCloud cloud = cloudOf(model, 0);
    MethodResult result = keep(cloud);
    EXPECT_EQ(measure(cloud, result, quick()).recession, 0);
    for (Position& p : result.points)
      for (std::size_t axis = 0; axis < 2; ++axis)
        p[axis] = 0.5 + (p[axis] - 0.5) * (1 - 2 * 3 * cloud.spacing);
    const Figures f = measure(cloud, result, quick());
    EXPECT_GT(f.recession, 2.9);
    EXPECT_LT(f.recession, 3 * std::sqrt(2));
    EXPECT_NEAR(f.boundary_pull, 3, 0.2);
  }
}

TEST(Measure, MergedAndSwappedSheetsAreCounted)
{
  const NoisyCloud cloud = cloudOf("sheets", 0);
  MethodResult result = keep(cloud);
  EXPECT_EQ(measure(cloud, result, quick()).wrong_sheet, 0);
  for (std::size_t i = 0; i < kCount / 4; ++i)
    result.points[i][2] *= -1;
  for (std::size_t i = kCount / 4; i < kCount / 2; ++i)
    result.points[i][2] *= 0.3;
  const Figures f = measure(cloud, result, quick());
  EXPECT_DOUBLE_EQ(f.wrong_sheet, 0.25);
  EXPECT_DOUBLE_EQ(f.middle_of_gap, 0.25);
}

} // namespace
} // namespace pcl_gpf::quality
