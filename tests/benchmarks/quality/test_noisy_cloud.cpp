// SPDX-License-Identifier: BSD-3-Clause
#include "noisy_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_gpf::quality {
namespace {

constexpr std::size_t kCount = 60000;

struct Deviation {
  double along_normal = 0, all = 0, largest = 0; ///< root mean squares, the second an axis; largest on any axis
};

Deviation
deviationOf(const NoisyCloud& cloud)
{
  Deviation d;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Position step = subtract(cloud.points[i], cloud.clean[i].point);
    d.along_normal += dot(step, cloud.clean[i].normal) * dot(step, cloud.clean[i].normal);
    d.all += dot(step, step) / 3;
    for (const double c : step)
      d.largest = std::max(d.largest, std::abs(c));
  }
  d.along_normal = std::sqrt(d.along_normal / static_cast<double>(cloud.points.size()));
  d.all = std::sqrt(d.all / static_cast<double>(cloud.points.size()));
  return d;
}

NoisyCloud
cubeWith(NoiseKind kind, double percent, double outliers = 0)
{
  return makeNoisyCloud(makeModel("cube", kCount), kCount, {kind, percent, outliers, 5});
}

const double kOnePercent = 0.01 * std::sqrt(3);

TEST(NoisyCloud, NoNoiseLeavesTheCleanPoints)
{
  for (const NoiseKind kind : {NoiseKind::Gaussian, NoiseKind::Normal, NoiseKind::Uniform, NoiseKind::Scanner})
    EXPECT_EQ(deviationOf(cubeWith(kind, 0)).largest, 0);
}

TEST(NoisyCloud, GaussianHasItsDeviationOnEveryAxis)
{
  const Deviation d = deviationOf(cubeWith(NoiseKind::Gaussian, 1));
  EXPECT_NEAR(d.all, kOnePercent, 0.01 * kOnePercent);
  EXPECT_NEAR(d.along_normal, kOnePercent, 0.01 * kOnePercent);
}

TEST(NoisyCloud, NormalNoiseLeavesTheTangentPlaneAlone)
{
  const Deviation d = deviationOf(cubeWith(NoiseKind::Normal, 1));
  EXPECT_NEAR(d.along_normal, kOnePercent, 0.01 * kOnePercent);
  EXPECT_NEAR(d.all, kOnePercent / std::sqrt(3), 0.01 * kOnePercent);
}

TEST(NoisyCloud, UniformStaysWithinItsLevel)
{
  const Deviation d = deviationOf(cubeWith(NoiseKind::Uniform, 1));
  EXPECT_LE(d.largest, kOnePercent * (1 + 1e-9));
  EXPECT_NEAR(d.all, kOnePercent / std::sqrt(3), 0.01 * kOnePercent);
}

/** Seen from the eye, steps along the ray are three times as large as across, and far points move more than near ones.
 */
TEST(NoisyCloud, ScannerNoiseFollowsTheRays)
{
  const NoisyCloud cloud = cubeWith(NoiseKind::Scanner, 1);
  EXPECT_NEAR(deviationOf(cloud).all, kOnePercent, 0.01 * kOnePercent);
  const Position eye = addScaled({0.5, 0.5, 0.5}, 1.5 * std::sqrt(3), normalized({0.6, -0.5, 0.7}));
  double along = 0, across = 0, near_side = 0, far_side = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Position step = subtract(cloud.points[i], cloud.clean[i].point), n = cloud.clean[i].normal;
    const double ray = dot(step, normalized(subtract(cloud.clean[i].point, eye)));
    along += ray * ray;
    across += (dot(step, step) - ray * ray) / 2;
    if (n[2] != 0)
      (n[2] > 0 ? near_side : far_side) += ray * ray;
  }
  EXPECT_NEAR(std::sqrt(along / across), 3, 0.05);
  EXPECT_GT(far_side, near_side);
}

TEST(NoisyCloud, OutliersAreMarkedAndFillTheEnlargedBox)
{
  const NoisyCloud clean = cubeWith(NoiseKind::Gaussian, 1), cloud = cubeWith(NoiseKind::Gaussian, 1, 0.05);
  EXPECT_EQ(std::accumulate(cloud.is_outlier.begin(), cloud.is_outlier.end(), 0), 3000);
  double sum = 0, low = 1, high = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (cloud.is_outlier[i] == 0) {
      EXPECT_EQ(cloud.points[i], clean.points[i]);
      continue;
    }
    sum += cloud.points[i][0];
    low = std::min(low, cloud.points[i][0]);
    high = std::max(high, cloud.points[i][0]);
  }
  EXPECT_NEAR(sum / 3000, 0.5, 0.03);
  EXPECT_NEAR(low, -0.1, 0.01);
  EXPECT_NEAR(high, 1.1, 0.01);
}

TEST(NoisyCloud, CleanPointsDoNotDependOnTheNoise)
{
  const NoisyCloud a = cubeWith(NoiseKind::Gaussian, 1), b = cubeWith(NoiseKind::Scanner, 3, 0.01);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_EQ(a.clean[i].point, b.clean[i].point);
}

} // namespace
} // namespace pcl_gpf::quality
