// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/outlier_probability.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/** A noisy square put on its plane, and points above it that were put on it or left. */
struct Scene {
  std::vector<Vector3> data, filtered;
  std::vector<float> moves;

  explicit Scene(std::size_t count, double noise)
  {
    data = plane(count, noise, 9).points;
    SplitMix64 random(10);
    for (std::size_t i = 0; i < count / 10; ++i)
      data.push_back({random.uniform(), random.uniform(), 0.5 * random.uniform()});
    for (const Vector3& p : data) {
      const bool near = std::abs(p[2]) < 0.1;
      filtered.push_back({p[0], p[1], near ? 0.0 : p[2]});
      moves.push_back(near ? static_cast<float>(std::abs(p[2])) : 0.0f);
    }
  }
  std::vector<float>
  probabilities(const OutlierProbabilityParameters& p) const
  {
    return outlierProbabilities(p, PointIndex(toBuffer(data).view()), toBuffer(filtered), moves.data());
  }
};

OutlierProbabilityParameters
parameters()
{
  OutlierProbabilityParameters p;
  p.noise = 0.01;
  p.spacing = 0.015;
  p.data_radius = 0.08;
  return p;
}

/** The two densities as the header tells them; support is counted by brute force, the ball's cross-section by integration. */
double
literalProbability(const OutlierProbabilityParameters& p, const Scene& scene, std::size_t i)
{
  const double ball = std::clamp(2.5 * p.noise, 3 * p.spacing, 8 * p.spacing), width = std::max(1.25 * p.noise, 0.5 * p.spacing);
  double support = 0;
  for (std::size_t j = 0; j < scene.data.size(); ++j)
    support += j != i && distance(scene.data[j], scene.filtered[i]) < ball;
  const double expected = kPi * p.data_radius * p.data_radius / (p.spacing * p.spacing);
  const double uniform = p.outlier_weight * expected / (4.0 / 3 * kPi * std::pow(p.data_radius, 3));
  const double background = uniform * 4.0 / 3 * kPi * std::pow(ball, 3);
  double area = 0;
  constexpr int kSteps = 20000;
  for (int s = 0; s < kSteps; ++s) {
    const double height = ball * (2 * (s + 0.5) / kSteps - 1);
    area += kPi * (ball * ball - height * height) * std::exp(-0.5 * std::pow(height / p.noise, 2)) / (p.noise * std::sqrt(2 * kPi)) *
            2 * ball / kSteps;
  }
  const double surface = std::max(0.0, support - background - 2 * std::sqrt(background)) / area *
                         std::exp(-0.5 * std::pow(scene.moves[i] / width, 2)) / (width * std::sqrt(2 * kPi));
  return uniform / (uniform + surface);
}

TEST(OutlierProbability, aFilterNarrowerThanTheSpacingDoesNotMakeOutliersOfAllPoints)
{
  const Scene scene(4000, 0.01);
  OutlierProbabilityParameters p = parameters();
  p.data_radius = 3 * p.spacing; // the ball in which support is counted
  const std::vector<float> at_the_ball = scene.probabilities(p);
  p.data_radius = 0.1 * p.spacing;
  EXPECT_EQ(scene.probabilities(p), at_the_ball);
  const auto flagged = std::count_if(at_the_ball.begin(), at_the_ball.begin() + 4000, [](float q) { return q > 0.5f; });
  EXPECT_LT(flagged, 40);
}

TEST(OutlierProbability, agreesWithALiteralEvaluation)
{
  const Scene scene(3000, 0.01);
  const std::vector<float> p = scene.probabilities(parameters());
  for (std::size_t i = 0; i < p.size(); ++i)
    ASSERT_NEAR(p[i], literalProbability(parameters(), scene, i), 1e-4) << i;
}

TEST(OutlierProbability, growsWithTheMoveAndIsOneWithoutSupport)
{
  Scene scene(4000, 0.01);
  for (float& move : scene.moves)
    move = 0.0f;
  const float at_rest = scene.probabilities(parameters())[0];
  scene.moves[0] = 0.03f;
  const float three = scene.probabilities(parameters())[0];
  scene.moves[0] = 0.06f;
  const float six = scene.probabilities(parameters())[0];
  EXPECT_LT(at_rest, 0.05f);
  EXPECT_GT(three, at_rest);
  EXPECT_LT(three, 0.5f);
  EXPECT_GT(six, 0.99f);
  scene.filtered[0] = {0.5, 0.5, 7.0};
  EXPECT_EQ(scene.probabilities(parameters())[0], 1.0f);
}

TEST(OutlierProbability, isZeroWithoutAUniformComponent)
{
  OutlierProbabilityParameters p = parameters();
  p.outlier_weight = 0.0;
  for (const float probability : Scene(500, 0.01).probabilities(p))
    EXPECT_EQ(probability, 0.0f);
}

TEST(OutlierProbability, ofACloudWithoutNoiseIsFiniteAndSmall)
{
  OutlierProbabilityParameters p = parameters();
  p.noise = 0.0;
  Scene scene(4000, 0.0);
  const std::vector<float> probability = scene.probabilities(p);
  for (std::size_t i = 0; i < 4000; ++i)
    ASSERT_LT(probability[i], 0.5f);
}

TEST(OutlierProbability, doesNotDependOnThreads)
{
  const Scene scene(3000, 0.01);
  OutlierProbabilityParameters p = parameters();
  p.number_of_threads = 1;
  const std::vector<float> one = scene.probabilities(p);
  p.number_of_threads = 4;
  EXPECT_EQ(scene.probabilities(p), one);
}

TEST(OutlierProbability, takesFewPointsAndRefusesBadParameters)
{
  const SoaBuffer single = toBuffer({{0, 0, 0}});
  const float no_move = 0.0f;
  EXPECT_EQ(outlierProbabilities(parameters(), PointIndex(single.view()), single, &no_move), std::vector<float>{1.0f});
  EXPECT_TRUE(outlierProbabilities(parameters(), PointIndex(single.view()), {}, nullptr).empty());
  const Scene scene(20, 0.01);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-1.0, nan}) {
    for (double OutlierProbabilityParameters::*field :
         {&OutlierProbabilityParameters::noise, &OutlierProbabilityParameters::spacing, &OutlierProbabilityParameters::data_radius,
          &OutlierProbabilityParameters::outlier_weight}) {
      OutlierProbabilityParameters p = parameters();
      p.*field = bad;
      EXPECT_THROW(scene.probabilities(p), InvalidParameter);
    }
  }
}

} // namespace
} // namespace pcl_gpf::test
