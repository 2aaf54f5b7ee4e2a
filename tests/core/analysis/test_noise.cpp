// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/analysis/spacing.h>

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
struct Case {
  const char* name;
  Maker make;
  double diagonal;
};

TEST(Noise, isFoundWithinAFifth)
{
  const Case cases[] = {{"plane", plane, std::sqrt(2.0)}, {"cube", cube, std::sqrt(3.0)}, {"sphere", sphere, std::sqrt(3.0)}};
  for (const Case& c : cases)
    for (const double percent : {0.25, 0.5, 1.0})
      for (const std::uint64_t seed : {1u, 2u}) {
        const double sigma = percent / 100 * c.diagonal;
        EXPECT_NEAR(noiseOf(turned(c.make(20000, sigma, seed))) / sigma, 1.0, 0.2) << c.name << " " << percent << " %";
      }
}

TEST(Noise, ofACleanSurfaceIsFarBelowItsSpacing)
{
  EXPECT_LT(noiseOf(turned(plane(5000))), 1e-5);
  EXPECT_LT(noiseOf(turned(sphere(5000))), 0.05 * std::sqrt(3.14 / 5000));
  EXPECT_LT(noiseOf(turned(cube(5000))), 0.05 * std::sqrt(6.0 / 5000));
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
