// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/synthetic_noise.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pcl_gpf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kCount = 100000;

std::vector<Position>
randomPoints(std::size_t count = kCount)
{
  SplitMix64 random(11);
  std::vector<Position> points(count);
  for (Position& point : points)
    point = {10 + random.uniform(), 20 + 2 * random.uniform(), 30 + 4 * random.uniform()};
  return points;
}

struct Moments {
  double mean = 0;
  double deviation = 0;
  double largest = 0;
};

/** \brief Moments of the displacement along one axis. */
Moments
moments(const std::vector<Position>& before, const std::vector<Position>& after, std::size_t axis)
{
  Moments m;
  const auto count = static_cast<double>(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double step = after[i][axis] - before[i][axis];
    m.mean += step / count;
    m.deviation += step * step / count;
    m.largest = std::max(m.largest, std::abs(step));
  }
  m.deviation = std::sqrt(m.deviation - m.mean * m.mean);
  return m;
}

TEST(SyntheticNoise, gaussianHasItsDeviationOnEveryAxis)
{
  const auto before = randomPoints();
  auto after = before;
  SyntheticNoise noise;
  noise.gaussian = 0.05;
  EXPECT_EQ(addNoise(noise, after).moved, kCount);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Moments m = moments(before, after, axis);
    EXPECT_NEAR(m.deviation, 0.05, 0.02 * 0.05);
    EXPECT_NEAR(m.mean, 0.0, 5 * 0.05 / std::sqrt(double(kCount)));
    EXPECT_GT(m.largest, 3.5 * 0.05);
  }
}

TEST(SyntheticNoise, uniformStaysInItsWidthAndFillsIt)
{
  const auto before = randomPoints();
  auto after = before;
  SyntheticNoise noise;
  noise.uniform = 0.05;
  addNoise(noise, after);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Moments m = moments(before, after, axis);
    EXPECT_NEAR(m.deviation, 0.05 / std::sqrt(3.0), 0.02 * 0.05 / std::sqrt(3.0));
    EXPECT_LE(m.largest, 0.05 + 1e-12);
    EXPECT_GT(m.largest, 0.0499);
  }
}

TEST(SyntheticNoise, alongTheNormalMovesOnlyAlongIt)
{
  const auto before = randomPoints();
  auto after = before;
  std::vector<Position> normals(kCount, Position{0, 0, -3}); // any length
  normals[5] = {0, 0, 0};
  normals[6] = {kNaN, 0, 1};
  SyntheticNoise noise;
  noise.along_normal = 0.05;
  const auto report = addNoise(noise, after, normals);
  EXPECT_EQ(report.without_normal, 2u);
  EXPECT_EQ(report.moved, kCount - 2);
  EXPECT_EQ(after[5], before[5]);
  EXPECT_EQ(after[6], before[6]);
  EXPECT_EQ(moments(before, after, 0).largest, 0.0);
  EXPECT_EQ(moments(before, after, 1).largest, 0.0);
  EXPECT_NEAR(moments(before, after, 2).deviation, 0.05, 0.02 * 0.05);
}

TEST(SyntheticNoise, outliersReplaceTheShareAndFillTheLargerBox)
{
  const auto before = randomPoints();
  auto after = before;
  SyntheticNoise noise;
  noise.outliers = 0.05;
  EXPECT_EQ(addNoise(noise, after).outliers, kCount / 20);
  std::size_t changed = 0, outside = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (after[i] == before[i])
      continue;
    ++changed;
    const Position centred = subtract(after[i], {10.5, 21, 32});
    const Position half{0.5, 1, 2};
    bool inner = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::abs(centred[axis]), 1.2001 * half[axis]);
      inner = inner && std::abs(centred[axis]) <= half[axis];
    }
    outside += !inner;
  }
  EXPECT_EQ(changed, kCount / 20);
  const double expected_outside = 1 - 1 / (1.2 * 1.2 * 1.2);
  EXPECT_NEAR(static_cast<double>(outside) / static_cast<double>(changed), expected_outside, 0.04);
}

TEST(SyntheticNoise, repeatsWithTheSeedAndOnlyWithIt)
{
  SyntheticNoise noise;
  noise.gaussian = noise.uniform = 0.01;
  noise.outliers = 0.1;
  auto first = randomPoints(1000), second = first, other = first;
  addNoise(noise, first);
  addNoise(noise, second);
  EXPECT_EQ(first, second);
  noise.seed = 2;
  addNoise(noise, other);
  EXPECT_NE(first, other);
}

TEST(SyntheticNoise, outliersLeaveTheNoiseOfTheOtherPointsAsItWas)
{
  SyntheticNoise noise;
  noise.gaussian = 0.01;
  auto without = randomPoints(1000), with = without;
  addNoise(noise, without);
  noise.outliers = 0.1;
  addNoise(noise, with);
  std::size_t different = 0;
  for (std::size_t i = 0; i < with.size(); ++i)
    different += with[i] != without[i];
  EXPECT_EQ(different, 100u);
}

TEST(SyntheticNoise, keepsRowsThatAreNotFinite)
{
  auto points = randomPoints(1000);
  for (const std::size_t row : {0u, 500u, 999u})
    points[row] = {kNaN, 1, 2};
  SyntheticNoise noise;
  noise.gaussian = 0.01;
  noise.outliers = 1.0;
  const auto report = addNoise(noise, points);
  EXPECT_EQ(report.moved, 997u);
  EXPECT_EQ(report.outliers, 997u);
  for (std::size_t row = 0; row < points.size(); ++row)
    EXPECT_EQ(std::isnan(points[row][0]), row == 0 || row == 500 || row == 999);
  EXPECT_EQ(points[500][2], 2.0);
}

TEST(SyntheticNoise, switchedOffChangesNothing)
{
  const auto before = randomPoints(100);
  auto after = before;
  const auto report = addNoise({}, after);
  EXPECT_EQ(after, before);
  EXPECT_EQ(report.moved + report.outliers, 0u);
}

TEST(SyntheticNoise, refusesParametersOutsideTheirRange)
{
  auto points = randomPoints(10);
  const auto expectRefused = [&](void (*change)(SyntheticNoise&)) {
    SyntheticNoise noise;
    change(noise);
    EXPECT_THROW(addNoise(noise, points), InvalidParameter);
  };
  expectRefused([](SyntheticNoise& n) { n.gaussian = -1; });
  expectRefused([](SyntheticNoise& n) { n.uniform = kNaN; });
  expectRefused([](SyntheticNoise& n) { n.outliers = 1.5; });
  expectRefused([](SyntheticNoise& n) { n.along_normal = 1; }); // no normals
  std::vector<Position> nothing;
  SyntheticNoise outliers;
  outliers.outliers = 0.5;
  EXPECT_THROW(addNoise(outliers, nothing), UnsuitableData);
}

} // namespace
} // namespace pcl_gpf
