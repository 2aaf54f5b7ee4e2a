// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/local_frame.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

double
noiseOf(const Shape& shape, double scale = 1.0, unsigned threads = 0)
{
  Shape scaled = shape;
  for (Vector3& p : scaled.points)
    p = {scale * p[0], scale * p[1], scale * p[2]};
  const SoaBuffer points = toBuffer(scaled.points);
  return estimateNoise(points.view(), estimateSpacing(points.view()), threads);
}

using Maker = Shape (*)(std::size_t count, double noise, std::uint64_t seed);
double
diagonalOf(const Shape& shape)
{
  BoundingBox box;
  for (const Vector3& p : shape.points)
    box.add(p[0], p[1], p[2]);
  return box.diagonal();
}

/** \brief Replaces the first points by ones anywhere in a box 1.2 times as large. */
Shape
withOutliers(Shape shape, double share)
{
  SplitMix64 random(99);
  Vector3 low = shape.points[0], high = low;
  for (const Vector3& p : shape.points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::fmin(low[axis], p[axis]);
      high[axis] = std::fmax(high[axis], p[axis]);
    }
  for (std::size_t i = 0; i < static_cast<std::size_t>(share * static_cast<double>(shape.size())); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      shape.points[i][axis] = low[axis] + (1.2 * random.uniform() - 0.1) * (high[axis] - low[axis]);
  return shape;
}

/** \brief Even noise of deviation `sigma` along the three axes. */
Shape
withEvenNoise(Shape shape, double sigma)
{
  SplitMix64 random(7);
  for (Vector3& p : shape.points)
    for (double& c : p)
      c += std::sqrt(3.0) * sigma * (2 * random.uniform() - 1);
  return shape;
}

/** \brief A shape of which the third axis becomes `axis`. */
Shape
facing(Shape shape, Vector3 axis)
{
  const double length = std::hypot(axis[0], axis[1], axis[2]), lateral = std::hypot(axis[0], axis[1]);
  const Vector3 n{axis[0] / length, axis[1] / length, axis[2] / length};
  const Vector3 u = lateral > 0 ? Vector3{axis[1] / lateral, -axis[0] / lateral, 0} : Vector3{1, 0, 0};
  const Vector3 v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  for (Vector3& p : shape.points)
    p = {p[0] * u[0] + p[1] * v[0] + p[2] * n[0], p[0] * u[1] + p[1] * v[1] + p[2] * n[1], p[0] * u[2] + p[1] * v[2] + p[2] * n[2]};
  return shape;
}

/** \brief A unit square whose density falls as 1 / sqrt(x). */
Shape
denseAtOneEnd(std::size_t count, double noise, std::uint64_t seed)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    const double root = random.uniform();
    point = {root * root, random.uniform(), 0};
    normal = {0, 0, 1};
  });
}

/** \brief A unit square with bosses 0.03 high, as wide as they are high up to five times as wide. */
Shape
bosses(std::size_t count, double noise, std::uint64_t seed)
{
  constexpr double kHeight = 0.03, kLength = 0.4;
  constexpr double kFrom[] = {0.05, 0.14, 0.24, 0.36, 0.5}, kWidth[] = {0.03, 0.04, 0.06, 0.08, 0.15};
  return sampleShape(count, noise, seed, [&](SplitMix64& random, Vector3& point, Vector3& normal) {
    const auto boss = static_cast<std::size_t>(5 * random.uniform());
    const double girth = 2 * (kLength + kWidth[boss]);
    if (random.uniform() < 5 * girth * kHeight / (1 + 5 * girth * kHeight)) {
      const double along = girth * random.uniform(), side = random.uniform() < 0.5 ? 0.0 : 1.0;
      const bool lengthwise = along < 2 * kLength;
      point = lengthwise ? Vector3{kFrom[boss] + side * kWidth[boss], 0.1 + 0.5 * along, kHeight * random.uniform()}
                         : Vector3{kFrom[boss] + 0.5 * (along - 2 * kLength), 0.1 + side * kLength, kHeight * random.uniform()};
      normal = lengthwise ? Vector3{2 * side - 1, 0, 0} : Vector3{0, 2 * side - 1, 0};
      return;
    }
    point = {random.uniform(), random.uniform(), 0};
    normal = {0, 0, 1};
    for (std::size_t k = 0; k < 5; ++k)
      if (point[1] > 0.1 && point[1] < 0.1 + kLength && point[0] > kFrom[k] && point[0] < kFrom[k] + kWidth[k])
        point[2] = kHeight;
  });
}

struct NoiseCase {
  const char* name;
  Maker make;
  double diagonal;
};

const NoiseCase kNoiseCases[] = {
  {"plane", plane, std::sqrt(2.0)},  {"cube", cube, std::sqrt(3.0)}, {"sphere", sphere, std::sqrt(3.0)},
  {"torus", torus, diagonalOf(torus(100000))}, {"scan lines", scanLines, diagonalOf(scanLines(100000))},
  {"dense at one end", denseAtOneEnd, std::sqrt(2.0)}};

TEST(Noise, isFoundWithinAFifth)
{
  for (const NoiseCase& c : kNoiseCases)
    for (const std::size_t count : {10000u, 80000u})
      for (const double percent : {0.1, 0.25, 0.5, 1.0, 1.5, 3.0}) {
        if (count > 10000u && percent != 0.25 && percent != 3.0)
          continue; // time
        const double sigma = percent / 100 * c.diagonal;
        EXPECT_NEAR(noiseOf(turned(c.make(count, sigma, 1))) / sigma, 1.0, 0.2) << c.name << " " << count << " " << percent << " %";
      }
}

TEST(Noise, isFoundFarAboveTheSpacing)
{
  const double sigma = 0.03 * std::sqrt(3.0); // 15 spacings
  EXPECT_NEAR(noiseOf(turned(cube(500000, sigma, 1))) / sigma, 1.0, 0.2);
}

TEST(Noise, alongTheNormalOrUniformIsFound)
{
  for (const NoiseCase& c : kNoiseCases)
    for (const double percent : {0.25, 1.5}) {
      const double sigma = percent / 100 * c.diagonal;
      SplitMix64 random(7);
      Shape along = c.make(20000, 0, 1), uniform = along;
      for (std::size_t i = 0; i < along.size(); ++i) {
        const double step = sigma * random.normal();
        for (std::size_t axis = 0; axis < 3; ++axis) {
          along.points[i][axis] += step * along.normals[i][axis];
          uniform.points[i][axis] += std::sqrt(3.0) * sigma * (2 * random.uniform() - 1);
        }
      }
      EXPECT_NEAR(noiseOf(turned(along)) / sigma, 1.0, 0.2) << c.name << " " << percent << " %";
      EXPECT_NEAR(noiseOf(turned(uniform)) / sigma, 1.0, 0.2) << c.name << " " << percent << " %";
    }
}

TEST(Noise, isFoundAmongOutliers)
{
  for (const NoiseCase& c : kNoiseCases)
    for (const double share : {0.01, 0.05})
      for (const double percent : {0.25, 1.0}) {
        const double sigma = percent / 100 * c.diagonal;
        const Shape shape = turned(withOutliers(c.make(20000, sigma, 1), share));
        EXPECT_NEAR(noiseOf(shape) / sigma, 1.0, 0.2) << c.name << " " << percent << " % outliers " << share;
      }
}

TEST(Noise, ofTwoCloseSheetsIsThatOfOne)
{
  const double sigma = 0.0025 * std::sqrt(2.0);
  for (const std::size_t count : {10000u, 33490u}) {
    const double gap = 4 * std::sqrt(2.0 / static_cast<double>(count));
    EXPECT_NEAR(noiseOf(turned(sheets(count, gap, sigma, 1))) / sigma, 1.0, 0.2) << count;
  }
}

TEST(Noise, ofAWallThinnerThanAPatchIsThatOfOneSide)
{
  for (const std::size_t count : {10000u, 33490u})
    for (const double spacings : {1.5, 2.5}) {
      const double gap = spacings * std::sqrt(2.0 / static_cast<double>(count));
      EXPECT_NEAR(noiseOf(turned(sheets(count, gap, gap / 6, 1))) / (gap / 6), 1.0, 0.2) << count << " " << spacings;
    }
}

TEST(Noise, thatIsEvenIsNotTakenForANormalOneThatWasTrimmed)
{
  const double sigma = 0.01 * std::sqrt(3.0);
  EXPECT_NEAR(noiseOf(turned(withEvenNoise(cube(20000, 0, 1), sigma))) / sigma, 1.0, 0.06);
}

TEST(Noise, ofTwoSheetsWhoseNoiseOverlapsIsThatOfOne)
{
  const std::size_t count = 33490;
  const double sigma = 2 * std::sqrt(2.0 / static_cast<double>(count));
  for (const double sigmas : {2.2, 3.0, 4.0})
    EXPECT_NEAR(noiseOf(turned(sheets(count, sigmas * sigma, sigma, 1))) / sigma, 1.0, 0.2) << sigmas;
  for (const double sigmas : {1.3, 2.5, 3.8})
    EXPECT_NEAR(noiseOf(turned(withEvenNoise(sheets(count, sigmas * sigma, 0, 1), sigma))) / sigma, 1.0, 0.2) << "even " << sigmas;
}

/** Flat like that of two sheets, to the eye, whatever the angle between the sheet and the axes. */
TEST(Noise, thatIsEvenOnOneSheetIsNotTakenForTwo)
{
  const std::size_t count = 33490;
  for (const double spacings : {2.0, 5.0}) {
    const double sigma = spacings / std::sqrt(static_cast<double>(count));
    for (const Vector3& axis : {Vector3{0, 0, 1}, Vector3{0.1, 0.2, 1}, Vector3{0.3, 0.6, 1}, Vector3{0, 1, 1}, Vector3{1, 1, 1}})
      EXPECT_NEAR(noiseOf(withEvenNoise(facing(plane(count, 0, 1), axis), sigma)) / sigma, 1.0, 0.2) << axis[0] << " " << spacings;
  }
  EXPECT_NEAR(noiseOf(withEvenNoise(sphere(count, 0, 1), 0.05)) / 0.05, 1.0, 0.2);
}

/** \brief Root mean square of a noise that grows threefold along x, on shapes with edges and without. */
TEST(Noise, thatVariesOverTheSurfaceIsItsRootMeanSquare)
{
  for (const NoiseCase& c : {kNoiseCases[0], kNoiseCases[1], kNoiseCases[2]})
    for (const double percent : {0.25, 1.0}) {
      Shape shape = c.make(33490, 0, 1);
      double low = 1e9, high = -1e9, squares = 0.0;
      for (const Vector3& p : shape.points) {
        low = std::fmin(low, p[0]);
        high = std::fmax(high, p[0]);
      }
      SplitMix64 random(3);
      for (Vector3& p : shape.points) {
        const double sigma = percent / 100 * c.diagonal * (0.5 + (p[0] - low) / (high - low));
        squares += sigma * sigma;
        for (double& coordinate : p)
          coordinate += sigma * random.normal();
      }
      const double rms = std::sqrt(squares / static_cast<double>(shape.size()));
      EXPECT_NEAR(noiseOf(turned(shape)) / rms, 1.0, 0.2) << c.name << " " << percent;
    }
}

/** Walls lower than the noise stay between floor and roof if the noise runs along the normals: layers thinner than the noise. */
TEST(Noise, alongNormalsIsNotThatOfWallsLowerThanIt)
{
  for (const double sigma : {0.005, 0.015, 0.021})
    for (const std::uint64_t seed : {1u, 2u}) {
      Shape shape = bosses(33490, 0, seed);
      SplitMix64 random(7);
      for (std::size_t i = 0; i < shape.size(); ++i) {
        const double step = sigma * random.normal();
        for (std::size_t axis = 0; axis < 3; ++axis)
          shape.points[i][axis] += step * shape.normals[i][axis];
      }
      EXPECT_NEAR(noiseOf(turned(shape)) / sigma, 1.0, 0.2) << sigma << " " << seed;
    }
}

TEST(Noise, ofACleanSurfaceIsFarBelowItsSpacing)
{
  for (const std::size_t count : {5000u, 50000u}) {
    const auto n = static_cast<double>(count);
    EXPECT_LT(noiseOf(turned(plane(count))), 0.02 * std::sqrt(1.0 / n));
    EXPECT_LT(noiseOf(turned(sphere(count))), 0.02 * std::sqrt(3.14 / n));
    EXPECT_LT(noiseOf(turned(cube(count))), 0.02 * std::sqrt(6.0 / n));
    EXPECT_LT(noiseOf(turned(torus(count))), 0.02 * std::sqrt(13.8 / n));
  }
}

TEST(Noise, scalesWithTheCloud)
{
  const Shape shape = turned(cube(5000, 0.01, 3));
  const double noise = noiseOf(shape);
  for (const double scale : {1e-4, 1e4})
    EXPECT_NEAR(noiseOf(shape, scale), scale * noise, 1e-3 * scale * noise);
}

TEST(Noise, doesNotDependOnThreads)
{
  const Shape shape = turned(cube(5000, 0.01, 3));
  EXPECT_EQ(noiseOf(shape, 1.0, 1), noiseOf(shape, 1.0, 3));
}

TEST(Noise, isZeroWhereNothingCanBeMeasured)
{
  EXPECT_EQ(noiseOf(Shape{}), 0.0);
  EXPECT_EQ(noiseOf(cube(15, 0.1, 1)), 0.0);
  EXPECT_EQ(noiseOf(cube(47, 0.1, 1)), 0.0);
  EXPECT_GT(noiseOf(cube(48, 0.1, 1)), 0.0);
  Shape identical;
  for (int i = 0; i < 1000; ++i)
    append(identical, {1, 2, 3}, {0, 0, 1});
  EXPECT_EQ(noiseOf(identical), 0.0);
  Shape line;
  for (int i = 0; i < 1000; ++i)
    append(line, turned(Vector3{0.001 * i, 0, 0}), {0, 0, 1});
  EXPECT_LT(noiseOf(line), 1e-6);
}

} // namespace
} // namespace pcl_gpf::test
