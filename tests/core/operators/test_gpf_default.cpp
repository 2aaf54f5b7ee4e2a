// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_run.h"

#include "support/literal_default_gpf.h"

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kPoints = 2000;

/** Runs `steps` steps and compares the displacement of each with the formula, evaluated where the filter itself stood before. */
void
compareSteps(const LocalCloud& cloud, const GPFParameters& p, const GPFInput& input, int steps)
{
  GPFState state = gpfInit(p, input);
  SoaBuffer normals(state.size());
  state.normals(normals.view());
  const std::vector<Vector3> n = toVectors(normals);
  const LiteralDefaultGPF literal{p, cloud.v, cloud.b};
  std::size_t undecided = 0, compared = 0;
  double largest_move = 0;
  for (int step = 0; step < steps; ++step) {
    const std::vector<Vector3> before = toVectors(positionsOf(state));
    gpfStep(state);
    const std::vector<Vector3> after = toVectors(positionsOf(state));
    const bool last = p.own_tangent_repulsion && p.maximum_iterations > 3 && step + 3 >= static_cast<int>(p.maximum_iterations);
    for (std::size_t m = 0; m < before.size(); ++m) {
      bool open = false;
      const Vector3 move = literal.displacement(before, n, m, p.repulsion_weight > 0 && !last, open);
      if (open) {
        ++undecided;
        continue;
      }
      ++compared;
      largest_move = std::fmax(largest_move, distance(move, {0, 0, 0}));
      ASSERT_LE(distance(after[m], {before[m][0] + move[0], before[m][1] + move[1], before[m][2] + move[2]}),
                1e-4 * p.support_radius)
          << "sample " << m << " in step " << step + 1;
    }
  }
  EXPECT_LT(undecided, compared / 20);
  EXPECT_GT(largest_move, 0.01 * p.support_radius) << "nothing was filtered";
}

GPFParameters
parametersFor(const LocalCloud& cloud)
{
  GPFParameters p;
  p.support_radius = 8.0 / std::sqrt(static_cast<double>(cloud.size()));
  return p;
}

TEST(GPFDefaultMode, equalsItsFormula)
{
  for (const NamedCloud& named : threeClouds(kPoints)) {
    SCOPED_TRACE(named.name);
    const auto p = parametersFor(named.cloud);
    const auto samples = everySecond(named.cloud.size());
    ASSERT_NO_FATAL_FAILURE(compareSteps(named.cloud, p, inputOf(named.cloud), 5));
    ASSERT_NO_FATAL_FAILURE(compareSteps(named.cloud, p, inputOf(named.cloud, &samples, bruteForceSearch), 2));
  }
}

TEST(GPFDefaultMode, equalsItsFormulaWithRepulsion)
{
  for (const NamedCloud& named : threeClouds(kPoints)) {
    SCOPED_TRACE(named.name);
    GPFParameters p = parametersFor(named.cloud);
    p.repulsion_weight = 0.3;
    const auto samples = everySecond(named.cloud.size());
    ASSERT_NO_FATAL_FAILURE(compareSteps(named.cloud, p, inputOf(named.cloud, &samples), 5));
  }
}

TEST(GPFDefaultMode, equalsItsFormulaWithEverySwitchTurned)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(kPoints, 0.01, 4)));
  for (const DataTerm term : {DataTerm::PointToPlane, DataTerm::Symmetric})
    for (const double normal_angle : {20.0, 90.0}) {
      GPFParameters p = parametersFor(cloud);
      p.data_term = term;
      p.normal_angle = normal_angle;
      p.normal_weight_floor = normal_angle < 90 ? 0.3 : 1.0;
      p.initial_variance = 0.01 * p.support_radius * p.support_radius;
      p.maximum_iterations = 2;
      p.repulsion_weight = 0.1;
      p.own_tangent_repulsion = term == DataTerm::Symmetric;
      ASSERT_NO_FATAL_FAILURE(compareSteps(cloud, p, inputOf(cloud), 2));
    }
}

} // namespace
} // namespace pcl_gpf::test
