// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/spacing.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

double
spacingOf(const Shape& shape)
{
  return estimateSpacing(toBuffer(shape.points).view());
}

TEST(Spacing, isTheRootOfTheAreaPerPoint)
{
  for (const std::size_t size : {2000u, 20000u}) {
    const auto n = static_cast<double>(size);
    EXPECT_NEAR(spacingOf(turned(plane(size))), std::sqrt(1.0 / n), 0.05 * std::sqrt(1.0 / n));
    EXPECT_NEAR(spacingOf(turned(cube(size))), std::sqrt(6.0 / n), 0.05 * std::sqrt(6.0 / n));
    EXPECT_NEAR(spacingOf(sphere(size)), std::sqrt(kPi / n), 0.05 * std::sqrt(kPi / n));
  }
}

TEST(Spacing, ofLengthsWhoseSquaresOverflowIsInfinite)
{
  SoaBuffer points(20);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.x[i] = 1e20f * static_cast<float>(i);
  EXPECT_TRUE(std::isinf(estimateSpacing(points.view())));
}

TEST(Spacing, withoutNoiseIsThatOfTheCleanSurface)
{
  for (const double noises : {0.3, 1.0, 3.0, 10.0})
    for (const std::size_t size : {20000u, 200000u}) {
      const auto n = static_cast<double>(size);
      const double square = std::sqrt(1.0 / n), ball = std::sqrt(kPi / n);
      if (noises * ball < 0.03) { // up to 3 % of the diagonal; the border of the square counts for more and more beyond
        EXPECT_NEAR(spacingWithoutNoise(spacingOf(plane(size, noises * square)), noises * square), square, 0.1 * square) << noises;
        EXPECT_NEAR(spacingWithoutNoise(spacingOf(sphere(size, noises * ball)), noises * ball), ball, 0.1 * ball) << noises;
      }
    }
}

TEST(Spacing, withoutNoiseTakesNothingAwayWhenThereIsNone)
{
  EXPECT_EQ(spacingWithoutNoise(0.5, 0.0), 0.5);
  EXPECT_EQ(spacingWithoutNoise(0.0, 0.5), 0.0);
  EXPECT_NEAR(spacingWithoutNoise(0.5, 1e-9), 0.5, 1e-9);
  EXPECT_NEAR(spacingWithoutNoise(0.5e-6, 1e-6), 1e-6 * spacingWithoutNoise(0.5, 1.0), 1e-18);
  EXPECT_GT(spacingWithoutNoise(1e-9, 1.0), 0.0);
}

TEST(Spacing, isNearlyTheStepOfAGrid)
{
  Shape grid;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      append(grid, {0.5 * x, 0.5 * y, 7}, {0, 0, 1});
  EXPECT_NEAR(spacingOf(grid), 0.5, 0.05);
}

TEST(Spacing, scalesWithTheCloudAndIgnoresOutliers)
{
  const Shape shape = cube(5000, 0.001, 2);
  const double spacing = spacingOf(shape);
  for (const double scale : {1e-3, 1e3}) {
    Shape scaled = shape;
    for (Vector3& p : scaled.points)
      p = {scale * p[0], scale * p[1], scale * p[2]};
    EXPECT_NEAR(spacingOf(scaled), scale * spacing, 1e-5 * scale * spacing);
  }
  Shape spoiled = shape;
  append(spoiled, {500, 500, 500}, {1, 0, 0});
  EXPECT_NEAR(spacingOf(spoiled), spacing, 0.02 * spacing);
}

TEST(Spacing, isZeroOnlyWithoutTwoDifferentPoints)
{
  Shape shape;
  EXPECT_EQ(spacingOf(shape), 0.0);
  for (int i = 0; i < 40; ++i) {
    append(shape, {0.5, 0.5, 0.5}, {0, 0, 1});
    EXPECT_EQ(spacingOf(shape), 0.0);
  }
  append(shape, {0.5, 0.5, 1.5}, {0, 0, 1});
  EXPECT_GT(spacingOf(shape), 0.0);
  for (int i = 0; i < 40; ++i) // two piles: every 16th neighbour coincides
    append(shape, {0.5, 0.5, 1.5}, {0, 0, 1});
  EXPECT_GT(spacingOf(shape), 0.0);
}

TEST(Spacing, doesNotDependOnThreads)
{
  const SoaBuffer points = toBuffer(cube(20000, 0.01, 2).points);
  EXPECT_EQ(estimateSpacing(points.view(), 3), estimateSpacing(points.view(), 1));
}

} // namespace
} // namespace pcl_gpf::test
