// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"
#include "support/shapes.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/scale_selection.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kCount = 20000;
constexpr double kSpacing = 0.00707; // of so many points on a unit square
constexpr double kNoise = 0.01;

/** A noisy height field over the unit square, and the flat surface that a coarse filter made of it. */
struct Scene {
  PointIndex points;
  SoaBuffer coarse, up;

  template <typename Height>
  static SoaBuffer
  sample(const Height& height, std::size_t count)
  {
    SplitMix64 random(7);
    SoaBuffer cloud(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = random.uniform(), y = random.uniform();
      cloud.x[i] = static_cast<float>(x);
      cloud.y[i] = static_cast<float>(y);
      cloud.z[i] = static_cast<float>(height(x, y) + kNoise * random.normal());
    }
    return cloud;
  }

  template <typename Height>
  explicit Scene(const Height& height, std::size_t count = kCount) : Scene(PointIndex(sample(height, count).view(), 1))
  {}

  explicit Scene(PointIndex index) : points(std::move(index)), coarse(points.size()), up(points.size())
  {
    const PointsView sorted = points.sorted();
    for (std::size_t k = 0; k < sorted.size; ++k) {
      coarse.x[k] = sorted.x[k];
      coarse.y[k] = sorted.y[k];
      up.z[k] = 1.0f;
    }
  }

  std::vector<std::uint8_t>
  select(ScaleSelectionParameters p = parameters()) const
  {
    SoaBuffer positions(coarse.size());
    for (std::size_t k = 0; k < coarse.size(); ++k) {
      positions.x[k] = coarse.x[k];
      positions.y[k] = coarse.y[k];
      positions.z[k] = coarse.z[k];
    }
    return selectFineScale(p, points, std::move(positions), up);
  }

  static ScaleSelectionParameters
  parameters()
  {
    return {kNoise, kSpacing, 0.025, 0.06, 0};
  }
};

double
flat(double, double)
{
  return 0.0;
}

bool
onBoss(double x, double y)
{
  return std::abs(x - 0.5) < 0.12 && std::abs(y - 0.5) < 0.12;
}

double
boss(double x, double y)
{
  return onBoss(x, y) ? 1.5 * kNoise : 0.0;
}

double
share(const std::vector<std::uint8_t>& fine)
{
  return std::accumulate(fine.begin(), fine.end(), 0.0) / static_cast<double>(fine.size());
}

TEST(ScaleSelection, noiseAloneIsLeftToTheCoarseScale)
{
  EXPECT_LT(share(Scene(flat).select()), 0.05);
}

TEST(ScaleSelection, copiesOfPointsAreNoFurtherEvidence)
{
  for (const std::size_t copies : {2u, 3u, 5u}) {
    SoaBuffer cloud(copies * kCount);
    const SoaBuffer once = Scene::sample(flat, kCount);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      cloud.x[i] = once.x[i / copies];
      cloud.y[i] = once.y[i / copies];
      cloud.z[i] = once.z[i / copies];
    }
    EXPECT_LT(share(Scene(PointIndex(static_cast<const SoaBuffer&>(cloud).view(), 1)).select()), 0.05) << copies;
  }
}

TEST(ScaleSelection, aBossThatTheCoarseSurfaceLacksIsLeftToTheFineScale)
{
  const Scene scene(boss);
  const std::vector<std::uint8_t> fine = scene.select();
  std::size_t on = 0, fine_on = 0, far = 0, fine_far = 0;
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const double x = scene.points.sorted().x[k], y = scene.points.sorted().y[k];
    if (onBoss(x, y)) {
      ++on;
      fine_on += fine[k];
    } else if (std::hypot(x - 0.5, y - 0.5) > 0.3) {
      ++far;
      fine_far += fine[k];
    }
  }
  EXPECT_GT(static_cast<double>(fine_on), 0.99 * static_cast<double>(on));
  EXPECT_LT(static_cast<double>(fine_far), 0.05 * static_cast<double>(far));
}

TEST(ScaleSelection, twoSheetsDrawnTogetherAreSeenByTheirSpread)
{
  SplitMix64 random(3);
  const Scene scene([&random](double, double) { return random.below(2) == 0 ? 4 * kNoise : -4 * kNoise; });
  EXPECT_GT(share(scene.select()), 0.99);
}

TEST(ScaleSelection, strongerNoiseIsNotDetailButTwoSheetsInItAre)
{
  for (const double factor : {1.5, 2.0, 3.0})
    for (const bool outliers : {false, true}) {
      SplitMix64 random(5);
      // Noise is `factor` times as strong beyond the middle; two sheets lie there, three noises from their mean, where y > 2 / 3.
      const auto stronger = [&](double x, double) {
        const double outlier = outliers && random.below(100) == 0 ? 20 * kNoise : 0.0;
        return outlier + (x > 0.5 ? std::sqrt(factor * factor - 1) * kNoise * random.normal() : 0.0);
      };
      const auto sheets = [&](double x, double y) {
        const double side = random.below(2) == 0 ? 3 * factor : -3 * factor;
        return stronger(x, y) + (x > 0.5 && y > 2.0 / 3 ? side * kNoise : 0.0);
      };
      const Scene scene(sheets);
      const std::vector<std::uint8_t> fine = scene.select();
      double noisy = 0, fine_noisy = 0, in_sheets = 0, fine_in_sheets = 0;
      for (std::size_t k = 0; k < fine.size(); ++k) {
        const double x = scene.points.sorted().x[k], y = scene.points.sorted().y[k];
        if (x > 0.6 && y > 0.77)
          ++in_sheets, fine_in_sheets += fine[k];
        else if (y < 0.55)
          ++noisy, fine_noisy += fine[k];
      }
      EXPECT_LT(fine_noisy, 0.1 * noisy) << factor << ' ' << outliers;
      EXPECT_GT(fine_in_sheets, 0.95 * in_sheets) << factor << ' ' << outliers;
    }
}

TEST(ScaleSelection, aPatchAcrossAnEdgeOfTheCoarseSurfaceSaysNothing)
{
  // Normals of two faces, in stripes narrower than a patch: every patch has both.
  Scene scene(boss);
  for (std::size_t k = 0; k < kCount; ++k)
    if (std::fmod(static_cast<double>(scene.coarse.x[k]), 0.02) < 0.01) {
      scene.up.z[k] = 0.0f;
      scene.up.x[k] = 1.0f;
    }
  EXPECT_EQ(share(scene.select()), 0.0);
}

TEST(ScaleSelection, doesNotDependOnSignsOrThreads)
{
  Scene scene(boss);
  ScaleSelectionParameters p = Scene::parameters();
  p.number_of_threads = 1;
  const std::vector<std::uint8_t> one = scene.select(p);
  p.number_of_threads = 3;
  EXPECT_EQ(scene.select(p), one);
  for (std::size_t k = 0; k < kCount; ++k)
    scene.up.z[k] = -1.0f;
  EXPECT_EQ(scene.select(p), one);
}

TEST(ScaleSelection, denseCloudsAreProbedAndStillDecided)
{
  const Scene scene(boss, 8 * kCount); // a spacing far below the noise: one probe stands for several points
  ScaleSelectionParameters p = Scene::parameters();
  p.spacing = kSpacing / std::sqrt(8.0);
  const std::vector<std::uint8_t> fine = scene.select(p);
  EXPECT_GT(share(fine), 0.24 * 0.24);
  EXPECT_LT(share(fine), 0.25);
}

TEST(ScaleSelection, refusesLengthsThatDecideNothing)
{
  const Scene scene(flat, 100);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ScaleSelectionParameters& p : {ScaleSelectionParameters{-1, kSpacing, 0.02, 0.06, 0}, {nan, kSpacing, 0.02, 0.06, 0},
                                            {kNoise, 0, 0.02, 0.06, 0}, {kNoise, kSpacing, 0, 0.06, 0}, {kNoise, kSpacing, 0.06, 0.06, 0}})
    EXPECT_THROW(scene.select(p), InvalidParameter);
}

TEST(ScaleSelection, fewPointsAndNoNoiseAreDecidedToo)
{
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{17}})
    EXPECT_EQ(Scene(flat, count).select().size(), count);
  ScaleSelectionParameters p = Scene::parameters();
  p.noise = 0.0;
  EXPECT_EQ(Scene(boss).select(p).size(), kCount);
}

} // namespace
} // namespace pcl_gpf::test
