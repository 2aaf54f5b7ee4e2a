// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_run.h"

#include "support/literal_gpf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kPoints = 3000;
constexpr int kSteps = 5;

GPFParameters
paperParameters(const LocalCloud& cloud)
{
  GPFParameters p = GPFParameters::paper();
  p.support_radius = 8.0 / std::sqrt(static_cast<double>(cloud.size())); // 8 h0
  return p;
}

LiteralGPF
literalOf(const LocalCloud& cloud, const std::vector<std::uint32_t>& samples, const GPFParameters& p)
{
  LiteralGPF literal;
  literal.v = cloud.v;
  literal.b = cloud.b;
  for (const std::uint32_t sample : samples) {
    literal.x.push_back(cloud.v[sample]);
    literal.b_x.push_back(cloud.b[sample]);
  }
  literal.h = p.support_radius;
  literal.omega = p.outlier_weight;
  literal.mu = p.repulsion_weight;
  literal.variance = p.initial_variance;
  return literal;
}

double
largestDistance(const SoaBuffer& positions, const std::vector<Vector3>& expected)
{
  double largest = 0;
  for (std::size_t m = 0; m < expected.size(); ++m)
    largest = std::fmax(largest, distance({positions.x[m], positions.y[m], positions.z[m]}, expected[m]));
  return largest;
}

/** Steps of Algorithm 1 beside the equations written out in double, with and without a foreign search. */
TEST(GPFPaperMode, equalsTheEquationsAfterOneAndAfterFiveSteps)
{
  for (const NamedCloud& named : threeClouds(kPoints)) {
    SCOPED_TRACE(named.name);
    const LocalCloud& cloud = named.cloud;
    const GPFParameters p = paperParameters(cloud);
    const auto samples = everySecond(cloud.size());
    LiteralGPF literal = literalOf(cloud, samples, p);
    GPFState built_in = gpfInit(p, inputOf(cloud, &samples));
    GPFState foreign = gpfInit(p, inputOf(cloud, &samples, bruteForceSearch));
    for (int step = 1; step <= kSteps; ++step) {
      SCOPED_TRACE("step " + std::to_string(step));
      const double variance = literal.variance;
      literal.step();
      for (GPFState* state : {&built_in, &foreign}) {
        const IterationStats stats = gpfStep(*state);
        EXPECT_LE(largestDistance(positionsOf(*state), literal.x), 1e-4 * p.support_radius);
        EXPECT_NEAR(stats.variance, variance, 1e-6 * variance);
        EXPECT_NEAR(stats.next_variance, literal.variance, 1e-6 * literal.variance);
        EXPECT_NEAR(stats.posterior_sum, literal.n_p, 1e-6 * literal.n_p);
        EXPECT_GT(stats.max_movement, 1e-3 * p.support_radius) << "nothing was filtered";
      }
    }
  }
}

TEST(GPFPaperMode, equalsTheEquationsWithoutDensityWeightsAndRepulsion)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1500, 0.01, 5)));
  GPFParameters p = paperParameters(cloud);
  p.density_weights = false;
  p.repulsion_weight = 0.0;
  p.outlier_weight = 0.3;
  p.initial_variance = 1e-4; // narrow enough for omega to matter
  const auto samples = everySecond(cloud.size());
  LiteralGPF literal = literalOf(cloud, samples, p);
  literal.density_weights = false;
  GPFState state = gpfInit(p, inputOf(cloud, &samples));
  for (int step = 1; step <= kSteps; ++step) {
    literal.step();
    const IterationStats stats = gpfStep(state);
    EXPECT_LE(largestDistance(positionsOf(state), literal.x), 1e-4 * p.support_radius) << "step " << step;
    EXPECT_NEAR(stats.posterior_sum, literal.n_p, 1e-6 * literal.n_p);
  }
}

TEST(GPFPaperMode, dividesByOneDegreeOfFreedomWhenAsked)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(800, 0.01, 6)));
  GPFParameters p = paperParameters(cloud);
  const IterationStats paper = [&] { GPFState state = gpfInit(p, inputOf(cloud)); return gpfStep(state); }();
  p.variance_update = VarianceUpdate::OneDegreeOfFreedom;
  const IterationStats one = [&] { GPFState state = gpfInit(p, inputOf(cloud)); return gpfStep(state); }();
  EXPECT_NEAR(one.next_variance, 3 * paper.next_variance, 1e-9 * one.next_variance);
}

TEST(GPFPaperMode, survivesVarianceThatFallsToZero)
{
  // A clean plane has no residual: eq. 11 gives 0 and eq. 3 would divide 0 by 0.
  const LocalCloud cloud = toLocalCloud(turned(plane(900)));
  GPFParameters p = paperParameters(cloud);
  p.repulsion_weight = 0.0;
  GPFState state = gpfInit(p, inputOf(cloud));
  for (int step = 0; step < 40; ++step) {
    const IterationStats stats = gpfStep(state);
    ASSERT_TRUE(std::isfinite(stats.next_variance));
    ASSERT_TRUE(std::isfinite(stats.mean_movement));
  }
  EXPECT_LE(largestDistance(positionsOf(state), cloud.v), 1e-6);
}

TEST(GPFPaperMode, addsTheRemaindersOfRounding)
{
  // Split coordinates: the float part and what it cut off, against the literal evaluation of their sum.
  LocalCloud cloud = toLocalCloud(turned(cube(600, 0.01, 8)));
  SoaBuffer remainders(cloud.size());
  SplitMix64 random(4);
  const auto samples = everySecond(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    remainders.x[i] = static_cast<float>(1e-3 * random.normal()); // far more than rounding, to be seen
    cloud.v[i][0] += remainders.x[i];
  }
  const GPFParameters p = paperParameters(cloud);
  LiteralGPF literal = literalOf(cloud, samples, p);
  GPFInput input = inputOf(cloud, &samples);
  input.remainders = remainders.view();
  // The search sees the float part only; a foreign one that returns every pair keeps the comparison exact.
  input.search = [](PointsView data, PointsView queries, double radius) { return bruteForceSearch(data, queries, radius + 0.02); };
  GPFState state = gpfInit(p, input);
  literal.step();
  gpfStep(state);
  EXPECT_LE(largestDistance(positionsOf(state), literal.x), 1e-6 * p.support_radius + 1e-7);
}

} // namespace
} // namespace pcl_gpf::test
