// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/quadric_fit.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace pcl_gpf::test {
namespace {

using Surface = std::function<std::array<double, 3>(double, double)>; ///< height and slopes over the square

constexpr std::size_t kCount = 12000;
constexpr double kSide = 0.6;

std::array<double, 3>
flat(double, double)
{
  return {0.0, 0.0, 0.0};
}

std::array<double, 3>
bowl(double x, double y)
{
  return {0.3 * x * x + 0.2 * y * y, 0.6 * x, 0.4 * y};
}

std::array<double, 3>
roof(double x, double)
{
  return {-0.6 * std::abs(x), x < 0 ? 0.6 : -0.6, 0.0};
}

/** Noisy points of a surface, and a filtered cloud with true normals that is off by a wave as long as a filter's ball. */
struct Scene {
  SoaBuffer noisy, filtered, normals;
  std::vector<double> x, y;
  Surface surface;

  Scene(const Surface& shape, double noise, double residue, std::size_t count = kCount) : noisy(count), filtered(count), normals(count), surface(shape)
  {
    SplitMix64 random(5);
    for (std::size_t i = 0; i < count; ++i) {
      x.push_back(kSide * (random.uniform() - 0.5));
      y.push_back(kSide * (random.uniform() - 0.5));
      const auto [height, slope_x, slope_y] = shape(x[i], y[i]);
      const double length = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
      const double n[3] = {-slope_x / length, -slope_y / length, 1 / length}, p[3] = {x[i], y[i], height};
      const double wave = residue * std::sin(90 * x[i]) * std::cos(90 * y[i]), deviation = noise * random.normal();
      float* to[3][3] = {{noisy.x.data(), noisy.y.data(), noisy.z.data()},
                         {filtered.x.data(), filtered.y.data(), filtered.z.data()},
                         {normals.x.data(), normals.y.data(), normals.z.data()}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        to[0][axis][i] = static_cast<float>(p[axis] + deviation * n[axis]);
        to[1][axis][i] = static_cast<float>(p[axis] + wave * n[axis]);
        to[2][axis][i] = static_cast<float>((i % 3 == 0 ? -1 : 1) * n[axis]); // free signs
      }
    }
  }

  /** Mean height error of the filtered points with lo <= |x| < hi. */
  double
  error(double lo = 0.0, double hi = 1.0) const
  {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < filtered.size(); ++i)
      if (const double at = std::abs(x[i]); at >= lo && at < hi) {
        sum += std::abs(filtered.z[i] - surface(filtered.x[i], filtered.y[i])[0]);
        ++count;
      }
    return sum / count;
  }
};

QuadricFitParameters
parameters(double noise)
{
  QuadricFitParameters p;
  p.radius = 0.08;
  p.noise = noise;
  p.spacing = kSide / std::sqrt(static_cast<double>(kCount));
  p.levels = 3;
  p.merge_above = 96;
  return p;
}

void
fit(const QuadricFitParameters& p, Scene& scene)
{
  fitQuadrics(p, scene.noisy.view(), scene.filtered.view(), scene.normals.view());
}

TEST(QuadricFit, leavesPlanesAndQuadricsWithoutNoiseWhereTheyAre)
{
  for (const Surface& shape : {Surface(flat), Surface(bowl)}) {
    Scene scene(shape, 0.0, 0.0);
    fit(parameters(1e-3), scene);
    for (std::size_t i = 0; i < scene.filtered.size(); ++i)
      ASSERT_NEAR(scene.filtered.z[i], scene.surface(scene.filtered.x[i], scene.filtered.y[i])[0], 5e-5);
  }
}

TEST(QuadricFit, takesMostOfTheResidueOffSmoothParts)
{
  for (const Surface& shape : {Surface(flat), Surface(bowl)}) {
    Scene scene(shape, 3e-3, 1e-3);
    const double before = scene.error();
    fit(parameters(3e-3), scene);
    EXPECT_LT(scene.error(), 0.7 * before);
  }
}

TEST(QuadricFit, doesNotTouchAnEdge)
{
  const Scene before(roof, 3e-3, 5e-4);
  Scene scene(roof, 3e-3, 5e-4);
  fit(parameters(3e-3), scene);
  for (std::size_t i = 0; i < scene.filtered.size(); ++i)
    if (std::abs(scene.x[i]) < 0.02) {
      ASSERT_EQ(scene.filtered.z[i], before.filtered.z[i]) << scene.x[i];
    }
  EXPECT_LT(scene.error(0.15, 0.25), before.error(0.15, 0.25));
}

TEST(QuadricFit, oneFitMayBeUnluckyWhereThoseAboutItAgree)
{
  Scene pooled(bowl, 3e-3, 1e-3), alone(bowl, 3e-3, 1e-3);
  QuadricFitParameters p = parameters(3e-3);
  fit(p, pooled);
  p.pooling = 0.0;
  fit(p, alone);
  EXPECT_LT(pooled.error(), 0.99 * alone.error());
}

TEST(QuadricFit, keepsTheSidesOfNormalsAndDoesNotDependOnThreads)
{
  Scene one(bowl, 3e-3, 1e-3), two(bowl, 3e-3, 1e-3);
  QuadricFitParameters p = parameters(3e-3);
  p.number_of_threads = 1;
  fit(p, one);
  p.number_of_threads = 2;
  fit(p, two);
  for (std::size_t i = 0; i < one.filtered.size(); ++i) {
    ASSERT_EQ(one.filtered.z[i], two.filtered.z[i]);
    ASSERT_EQ(one.normals.x[i], two.normals.x[i]);
    ASSERT_EQ(one.normals.z[i] < 0, i % 3 == 0);
  }
}

TEST(QuadricFit, fewAndCoincidentPointsStay)
{
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{40}}) {
    Scene scene(flat, 3e-3, 1e-3, count);
    const Scene before(flat, 3e-3, 1e-3, count);
    fit(parameters(3e-3), scene);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(scene.filtered.z[i], before.filtered.z[i]);
  }
  Scene pile(flat, 3e-3, 0.0);
  std::fill_n(pile.filtered.x.data(), kCount, 0.25f);
  std::fill_n(pile.filtered.y.data(), kCount, 0.25f);
  fit(parameters(3e-3), pile);
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(pile.filtered.x[i], 0.25f);
}

TEST(QuadricFit, refusesWhatItCannotUse)
{
  Scene scene(flat, 3e-3, 1e-3, 100);
  QuadricFitParameters p = parameters(3e-3);
  p.radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fit(p, scene), InvalidParameter);
  p.radius = 0.0;
  EXPECT_THROW(fit(p, scene), InvalidParameter);
  p = parameters(3e-3);
  p.merge_above = 3;
  EXPECT_THROW(fit(p, scene), InvalidParameter);
  SoaBuffer few(3);
  EXPECT_THROW(fitQuadrics(parameters(3e-3), scene.noisy.view(), few.view(), scene.normals.view()), InvalidParameter);
  EXPECT_THROW(fitQuadrics(parameters(3e-3), scene.noisy.view(), scene.filtered.view(), scene.normals.view(), [](double) { return false; }),
               Cancelled);
}

} // namespace
} // namespace pcl_gpf::test
