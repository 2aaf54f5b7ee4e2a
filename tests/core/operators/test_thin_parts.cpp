// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"
#include "support/shapes.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/thin_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kCount = 6000;
constexpr double kSpacing = 0.0129; // of so many points on a unit square
constexpr double kNoise = 0.3 * kSpacing;

ThinPartsParameters
parameters(unsigned threads = 0)
{
  return {kNoise, kSpacing, threads};
}

/** Points of sheets at z = +-half_gap with noise of some strength, and surfaces that filters made of them, all with normals along z. */
struct Scene {
  PointIndex points;
  std::vector<double> sheet; ///< z of the sheet on each sorted point's side
  SoaBuffer up;

  Scene(double half_gap, double noise, std::size_t count = kCount) : Scene(PointIndex(sample(half_gap, noise, count).view(), 1), half_gap)
  {}

  /** The surface of a filter that drew each sheet to this share of its distance and left this share of the heights above that. */
  SoaBuffer
  surface(double share_of_gap, double left) const
  {
    const PointsView p = points.sorted();
    SoaBuffer filtered(p.size);
    for (std::size_t k = 0; k < p.size; ++k) {
      const double target = share_of_gap * sheet[k];
      filtered.x[k] = p.x[k];
      filtered.y[k] = p.y[k];
      filtered.z[k] = static_cast<float>(target + (1 - left) * (static_cast<double>(p.z[k]) - target));
    }
    return filtered;
  }

private:
  static SoaBuffer
  sample(double half_gap, double noise, std::size_t count)
  {
    SplitMix64 random(9);
    SoaBuffer cloud(count);
    for (std::size_t i = 0; i < count; ++i) {
      cloud.x[i] = static_cast<float>(random.uniform());
      cloud.y[i] = static_cast<float>(random.uniform());
      cloud.z[i] = static_cast<float>((random.below(2) == 0 ? half_gap : -half_gap) + noise * random.normal());
    }
    return cloud;
  }

  Scene(PointIndex index, double half_gap) : points(std::move(index)), up(points.size())
  {
    for (std::size_t k = 0; k < points.size(); ++k) {
      up.z[k] = 1.0f;
      sheet.push_back(points.sorted().z[k] > 0 ? half_gap : -half_gap);
    }
  }
};

/** What a narrow filter leaves of the height of a point where noise has this strength (docs of confirmThinParts()). */
double
leftOf(double noise)
{
  return std::sqrt(std::max(0.25, 1 / (1 + 3.5 * noise * noise / (kSpacing * kSpacing))));
}

TEST(ThinParts, meanSquaresAreThoseOfTheHeightsInABall)
{
  const Scene scene(1.0 * kSpacing, kNoise);
  const ThinParts found = findThinParts(parameters(), scene.points, scene.surface(0, 1), scene.up);
  const PointsView p = scene.points.sorted();
  ASSERT_GT(found.places.size(), kCount / 2);
  for (std::size_t k = 0; k < found.places.size(); k += 50) {
    // Both sheets lie on z = 0 now: the ball is a disc. No height is beyond four deviations.
    const std::uint32_t i = found.places[k];
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < p.size; ++j) {
      const double dx = static_cast<double>(p.x[j]) - p.x[i], dy = static_cast<double>(p.y[j]) - p.y[i];
      if (dx * dx + dy * dy < 6.25 * kSpacing * kSpacing) {
        sum += static_cast<double>(p.z[j]) * p.z[j];
        ++count;
      }
    }
    EXPECT_NEAR(found.mean_squares[k], sum / count, 1e-4 * sum / count) << i;
  }
}

TEST(ThinParts, noiseOfTheCloudIsNone)
{
  const Scene scene(0, kNoise);
  EXPECT_LT(findThinParts(parameters(), scene.points, scene.surface(0, 1), scene.up).places.size(), kCount / 100);
}

TEST(ThinParts, mergedSheetsAreFoundAndConfirmedWhereANarrowFilterPartsThem)
{
  const Scene scene(0.75 * kSpacing, kNoise);
  const ThinParts found = findThinParts(parameters(), scene.points, scene.surface(0, 1), scene.up);
  EXPECT_GT(found.places.size(), kCount * 99 / 100);
  for (const bool fine : {false, true}) {
    const std::vector<std::uint8_t> all(kCount, fine ? 1 : 0);
    EXPECT_GT(confirmThinParts(parameters(), scene.points, found, scene.surface(1, leftOf(kNoise)), scene.up, all).size(),
              found.places.size() * 95 / 100);
    EXPECT_TRUE(confirmThinParts(parameters(), scene.points, found, scene.surface(0, 1), scene.up, all).empty()) << "they stayed merged";
  }
}

TEST(ThinParts, strongerNoiseIsFoundButNotConfirmedThoughANarrowFilterFollowsIt)
{
  for (const double factor : {2.0, 3.0, 5.0}) {
    const Scene scene(0, factor * kNoise);
    const ThinParts found = findThinParts(parameters(), scene.points, scene.surface(0, 1), scene.up);
    EXPECT_GT(found.places.size(), kCount * 9 / 10) << factor;
    for (const bool fine : {false, true})
      EXPECT_LT(confirmThinParts(parameters(), scene.points, found, scene.surface(0, leftOf(factor * kNoise)), scene.up,
                                 std::vector<std::uint8_t>(kCount, fine ? 1 : 0))
                    .size(),
                found.places.size() / 50)
          << factor;
  }
}

TEST(ThinParts, doNotDependOnSignsOrThreads)
{
  Scene scene(0.75 * kSpacing, kNoise);
  const std::vector<std::uint8_t> fine(kCount, 1);
  const ThinParts one = findThinParts(parameters(1), scene.points, scene.surface(0, 1), scene.up);
  const std::vector<std::uint32_t> kept = confirmThinParts(parameters(1), scene.points, one, scene.surface(1, 0.8), scene.up, fine);
  for (std::size_t k = 0; k < kCount; ++k)
    scene.up.z[k] = -1.0f;
  const ThinParts three = findThinParts(parameters(3), scene.points, scene.surface(0, 1), scene.up);
  EXPECT_EQ(three.places, one.places);
  EXPECT_EQ(three.mean_squares, one.mean_squares);
  EXPECT_EQ(confirmThinParts(parameters(3), scene.points, three, scene.surface(1, 0.8), scene.up, fine), kept);
}

TEST(ThinParts, fewOrSparsePointsAndNoNoiseHaveNone)
{
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, kCount / 20}) {
    const Scene scene(kSpacing, kNoise, count);
    const ThinParts found = findThinParts(parameters(), scene.points, scene.surface(0, 1), scene.up);
    EXPECT_LE(found.places.size(), count / 50);
    EXPECT_EQ(confirmThinParts(parameters(), scene.points, {}, scene.surface(1, 0), scene.up, std::vector<std::uint8_t>(count)).size(), 0u);
  }
  const Scene clean(0, 0, 100);
  EXPECT_TRUE(findThinParts({0.0, kSpacing, 0}, clean.points, clean.surface(1, 0), clean.up).places.empty());
}

TEST(ThinParts, refuseLengthsThatDecideNothingAndPlacesOfAnotherCloud)
{
  const Scene scene(kSpacing, kNoise, 100);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ThinPartsParameters& p : {ThinPartsParameters{-1, kSpacing, 0}, {nan, kSpacing, 0}, {kNoise, 0, 0}, {kNoise, nan, 0}})
    EXPECT_THROW(findThinParts(p, scene.points, scene.surface(0, 1), scene.up), InvalidParameter);
  const auto confirm = [&](const ThinParts& found, std::size_t scales) {
    confirmThinParts(parameters(), scene.points, found, scene.surface(0, 1), scene.up, std::vector<std::uint8_t>(scales));
  };
  EXPECT_THROW(confirm({{1, 100}, {1.0f, 1.0f}}, 100), InvalidParameter);
  EXPECT_THROW(confirm({{1, 2}, {1.0f}}, 100), InvalidParameter);
  EXPECT_THROW(confirm({{1}, {1.0f}}, 99), InvalidParameter);
}

} // namespace
} // namespace pcl_gpf::test
