// SPDX-License-Identifier: BSD-3-Clause
// Outliers, edge points, local noise and bounded moves as denoise() finds them; presets.
#include "support/columns.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/denoise.h>
#include <pcl_gpf/pipeline/presets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

double
moveOf(const Columns& cloud, const DenoiseResult& result, std::size_t k)
{
  const std::size_t row = result.sample_indices[k];
  return std::hypot(result.x[k] - cloud.x[row], result.y[k] - cloud.y[row], result.z[k] - cloud.z[row]);
}

/** A noisy sphere with every `every`-th point replaced by one above it, some of them in reach of the filter. */
std::vector<Vector3>
sphereWithOutliers(std::size_t count, std::size_t every, double nearest = 1.07)
{
  std::vector<Vector3> points = sphere(count, 0.005, 3).points;
  SplitMix64 random(4);
  for (std::size_t i = 0; i < count; i += every) {
    const double factor = nearest + 0.2 * random.uniform();
    for (double& c : points[i])
      c *= factor;
  }
  return points;
}

DenoiseParameters
withEverything()
{
  DenoiseParameters p;
  p.flags.sigma = p.flags.edges = true;
  return p;
}

TEST(DenoiseFlags, flagOutliersAndLeaveThemOutOfTheDataOfOthers)
{
  const std::size_t count = 20000, every = 25;
  const Columns cloud(sphereWithOutliers(count, every));
  const DenoiseResult result = denoise(cloud.input(), withEverything());
  ASSERT_EQ(result.outlier.size(), count);
  ASSERT_EQ(result.sigma.size(), count);
  ASSERT_EQ(result.edge.size(), count);
  EXPECT_TRUE(result.repeated);
  std::size_t missed = 0, alarms = 0;
  std::vector<Vector3> rest;
  const auto error = [](const DenoiseResult& r, std::size_t k) { return std::abs(std::hypot(r.x[k], r.y[k], r.z[k]) - 0.5); };
  double errors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool outlier = result.outlier[i] > DenoiseResult::kOutlier, is_outlier = i % every == 0;
    (is_outlier ? missed : alarms) += outlier != is_outlier;
    if (is_outlier)
      continue;
    rest.push_back({cloud.x[i], cloud.y[i], cloud.z[i]});
    errors += error(result, i);
  }
  EXPECT_LE(missed, count / every / 20);
  EXPECT_LE(alarms, count / 1000);

  const DenoiseResult alone = denoise(Columns(rest).input(), withEverything());
  double errors_alone = 0;
  for (std::size_t k = 0; k < rest.size(); ++k)
    errors_alone += error(alone, k);
  EXPECT_LE(errors, 1.02 * errors_alone);
  EXPECT_NEAR(result.scale.noise, alone.scale.noise, 0.05 * alone.scale.noise);
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_LE(moveOf(cloud, result, i), result.max_move);
}

TEST(DenoiseFlags, areLeftOutWhereTheyAreNotWanted)
{
  const Columns cloud(sphereWithOutliers(4000, 20));
  DenoiseParameters p;
  p.flags.outliers = false;
  const DenoiseResult result = denoise(cloud.input(), p);
  EXPECT_TRUE(result.outlier.empty() && result.sigma.empty() && result.edge.empty());
  EXPECT_FALSE(result.repeated);
}

TEST(DenoiseFlags, ofSamplesAndOfThePapersRecursionBelongToTheirPoints)
{
  const Columns cloud(sphereWithOutliers(6000, 30, 1.3));
  DenoiseParameters sampled = withEverything();
  sampled.gpf.sample_ratio = 0.5;
  DenoiseParameters paper = withEverything();
  paper.gpf = GPFParameters::paper();
  paper.gpf.maximum_iterations = 3;
  for (const DenoiseParameters& p : {sampled, paper}) {
    const DenoiseResult result = denoise(cloud.input(), p);
    ASSERT_EQ(result.outlier.size(), 3000u);
    ASSERT_EQ(result.edge.size(), 3000u);
    EXPECT_FALSE(result.repeated);
    std::size_t right = 0, outliers = 0, alarms = 0;
    for (std::size_t k = 0; k < 3000; ++k) {
      const bool is_outlier = result.sample_indices[k] % 30 == 0, flagged = result.outlier[k] > DenoiseResult::kOutlier;
      outliers += is_outlier;
      right += is_outlier && flagged;
      alarms += !is_outlier && flagged;
    }
    EXPECT_GT(outliers, 50u);
    EXPECT_GE(right, 9 * outliers / 10);
    EXPECT_LE(alarms, 30u);
  }
}

TEST(DenoiseFlags, sigmaTellsQuietFromNoisyPartsAndNoisyOnesAreNoOutliers)
{
  std::vector<Vector3> points = plane(20000, 0, 5).points;
  SplitMix64 random(6);
  for (Vector3& p : points)
    p[2] += (p[0] < 0.5 ? 0.01 : 0.015) * random.normal();
  const DenoiseResult result = denoise(Columns(points).input(), withEverything());
  double quiet = 0, noisy = 0, quiet_count = 0, noisy_count = 0, alarms = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (points[i][0] < 0.5 ? quiet : noisy) += result.sigma[i];
    ++(points[i][0] < 0.5 ? quiet_count : noisy_count);
    alarms += result.outlier[i] > DenoiseResult::kOutlier;
  }
  EXPECT_NEAR(quiet / quiet_count, 0.01, 0.0015);
  // A sixth too low at the most: radii fit the quiet half, and a ball of two of its own noises cuts the tails off.
  EXPECT_NEAR(noisy / noisy_count, 0.015, 0.0025);
  EXPECT_LE(alarms, 0.005 * static_cast<double>(points.size()));
}

TEST(DenoiseFlags, noNoiseIsTakenOutOfACloudThatStays)
{
  const Columns cloud(cube(48, 0.02, 3).points); // too few points to tell noise from shape
  const DenoiseResult result = denoise(cloud.input(), withEverything());
  ASSERT_EQ(result.max_move, 0.0);
  EXPECT_EQ(result.sigma, std::vector<double>(48, 0.0));
}

TEST(DenoiseFlags, doNotChangeWithThreads)
{
  const Columns cloud(sphereWithOutliers(8000, 25));
  DenoiseParameters p = withEverything();
  p.number_of_threads = 1;
  const DenoiseResult one = denoise(cloud.input(), p);
  p.number_of_threads = 3;
  const DenoiseResult three = denoise(cloud.input(), p);
  EXPECT_EQ(one.outlier, three.outlier);
  EXPECT_EQ(one.sigma, three.sigma);
  EXPECT_EQ(one.edge, three.edge);
  EXPECT_EQ(one.x, three.x);
}

TEST(DenoiseFlags, secondRunCanBeCancelled)
{
  const Columns cloud(sphereWithOutliers(4000, 20));
  EXPECT_THROW(denoise(cloud.input(), {}, [](const std::string& stage, double) { return stage != "repeated filter"; }), Cancelled);
}

TEST(DenoiseMaxMove, boundsEveryMoveAndCountsTheCut)
{
  const Columns cloud(cube(8000, 0.01, 2).points);
  DenoiseParameters p;
  p.max_move = 0.005;
  const DenoiseResult result = denoise(cloud.input(), p);
  EXPECT_EQ(result.max_move, 0.005);
  std::size_t at_limit = 0;
  for (std::size_t k = 0; k < result.x.size(); ++k) {
    ASSERT_LE(moveOf(cloud, result, k), 0.005);
    at_limit += moveOf(cloud, result, k) > 0.005 * (1 - 1e-5);
  }
  EXPECT_NEAR(static_cast<double>(result.limited_points), static_cast<double>(at_limit), 2.0);
  EXPECT_GT(at_limit, 1000u);
  EXPECT_EQ(result.parameters.back().name, "max_move");
  EXPECT_EQ(result.parameters.back().origin, "user");
  p.max_move = std::numeric_limits<double>::infinity();
  EXPECT_EQ(denoise(cloud.input(), p).limited_points, 0u);
}

TEST(DenoiseStrength, scalesTheLengthsThatTheNoiseDecides)
{
  const Columns cloud(cube(30000, 0.02, 2).points);
  const auto run = [&cloud](double strength) {
    DenoiseParameters p;
    p.strength = strength;
    return denoise(cloud.input(), p);
  };
  const DenoiseResult plain = run(1.0), strong = run(1.5);
  ASSERT_EQ(plain.parameters.size(), strong.parameters.size());
  for (std::size_t k = 0; k < plain.parameters.size(); ++k) {
    ASSERT_NE(plain.parameters[k].reason.find("noise"), std::string::npos) << plain.parameters[k].name;
    // The spacing's part of a length stays.
    EXPECT_GT(strong.parameters[k].value, 1.1 * plain.parameters[k].value) << plain.parameters[k].name;
    EXPECT_LE(strong.parameters[k].value, (1.5 + 1e-9) * plain.parameters[k].value) << plain.parameters[k].name;
  }
  EXPECT_NEAR(strong.max_move, 1.5 * plain.max_move, 1e-9);
  EXPECT_EQ(plain.scale.noise, strong.scale.noise);
  for (const double bad : {0.4, 2.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(run(bad), InvalidParameter);
}

TEST(DenoisePresets, areValidAndDoWhatTheyAreFor)
{
  const auto error = [](const Shape& shape, const DenoiseParameters& p, double (*distance)(const Vector3&)) {
    const DenoiseResult result = denoise(Columns(shape.points).input(), p);
    double sum = 0;
    for (std::size_t i = 0; i < result.x.size(); ++i)
      sum += distance({result.x[i], result.y[i], result.z[i]});
    return sum;
  };
  const auto cube_distance = [](const Vector3& p) {
    double outside_sq = 0, inside = 1;
    for (const double c : p) {
      outside_sq += std::pow(std::max({0.0, -c, c - 1}), 2);
      inside = std::min({inside, c, 1 - c});
    }
    return outside_sq > 0 ? std::sqrt(outside_sq) : inside;
  };
  const auto torus_distance = [](const Vector3& p) { return std::abs(std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.35); };
  const Shape box = cube(30000, 0.0173, 1), ring = torus(30000, 0.039, 1); // 1 % of the diagonal
  EXPECT_LT(error(box, prismaticPreset(), cube_distance), error(box, {}, cube_distance));
  EXPECT_LT(error(ring, freeformPreset(), torus_distance), error(ring, {}, torus_distance));
  EXPECT_NO_THROW(validate(paperPreset()));
}

} // namespace
} // namespace pcl_gpf::test
