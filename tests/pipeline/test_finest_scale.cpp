// SPDX-License-Identifier: BSD-3-Clause
#include "support/columns.h"
#include "support/shapes.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kCount = 12000;
constexpr double kSpacing = 0.0129; // of 6,000 points on a unit square

DenoiseResult
filter(const Shape& shape, bool thin_parts, unsigned threads = 0)
{
  DenoiseParameters p;
  p.thin_parts = thin_parts;
  p.number_of_threads = threads;
  return denoise(Columns(shape.points).input(), p);
}

/** A wall: two squares, and a floor as large beside it, from which the noise is known. */
Shape
wall(double thickness, double noise)
{
  return sampleShape(kCount + kCount / 2, noise, 3, [thickness](SplitMix64& random, Vector3& point, Vector3& normal) {
    const std::size_t part = random.below(3);
    point = {random.uniform(), random.uniform(), part == 1 ? thickness : 0.0};
    if (part == 2)
      point[0] += 1.5;
    normal = {0, 0, 1};
  });
}

TEST(FinestScale, keepsTheSidesOfAWallApartThatIsAsThickAsTheSpacing)
{
  const double thickness = 1.4 * kSpacing;
  const Shape shape = wall(thickness, 0.2 * kSpacing);
  const auto error = [&](const DenoiseResult& result) {
    double sum = 0;
    for (std::size_t i = 0; i < result.z.size(); ++i)
      if (shape.points[i][0] < 1.2)
        sum += std::min(std::abs(result.z[i]), std::abs(result.z[i] - thickness));
    return sum;
  };
  const DenoiseResult with = filter(shape, true), without = filter(shape, false);
  EXPECT_GT(with.finest_points, kCount * 3 / 4);
  EXPECT_EQ(without.finest_points, 0u);
  EXPECT_LT(error(with), 0.5 * error(without));
}

TEST(FinestScale, leavesTheNoisyHalfOfAPlaneAsFlatAsItWas)
{
  for (const double factor : {1.5, 2.0, 3.0}) {
    Shape shape = plane(kCount, 0, 5);
    SplitMix64 random(6);
    for (Vector3& p : shape.points)
      p[2] += (p[0] < 0.5 ? 0.002 : 0.002 * factor) * random.normal();
    const DenoiseResult with = filter(shape, true), without = filter(shape, false);
    double error = 0, error_without = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      error += std::abs(with.z[i]);
      error_without += std::abs(without.z[i]);
    }
    EXPECT_LT(error, 1.1 * error_without) << factor;
  }
}

TEST(FinestScale, takesNoPartWhereNoiseIsAboveHalfOfTheSpacingOrThereIsNone)
{
  EXPECT_EQ(filter(wall(1.4 * kSpacing, 0.6 * kSpacing), true).finest_points, 0u);
  const Shape clean = wall(1.4 * kSpacing, 0);
  const DenoiseResult result = filter(clean, true);
  for (std::size_t i = 0; i < clean.size(); ++i)
    ASSERT_EQ((Vector3{result.x[i], result.y[i], result.z[i]}), clean.points[i]);
}

TEST(FinestScale, doesNotDependOnThreads)
{
  const Shape shape = wall(1.4 * kSpacing, 0.2 * kSpacing);
  const DenoiseResult one = filter(shape, true, 1), three = filter(shape, true, 3);
  EXPECT_EQ(one.finest_points, three.finest_points);
  EXPECT_EQ(one.x, three.x);
  EXPECT_EQ(one.y, three.y);
  EXPECT_EQ(one.z, three.z);
}

} // namespace
} // namespace pcl_gpf::test
