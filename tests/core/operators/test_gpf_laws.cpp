// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_run.h"

#include <pcl_gpf/core/errors.h>

#include <gtest/gtest.h>

#include <limits>

namespace pcl_gpf::test {
namespace {

struct Mode {
  const char* name;
  GPFParameters parameters;
};

/** The default, the default with repulsion, and Algorithm 1. */
std::vector<Mode>
modes(double support_radius)
{
  GPFParameters standard, repelling, paper = GPFParameters::paper();
  repelling.repulsion_weight = 0.2;
  std::vector<Mode> all = {{"default", standard}, {"repulsion", repelling}, {"paper", paper}};
  for (Mode& mode : all)
    mode.parameters.support_radius = support_radius;
  return all;
}

TEST(GPF, givesTheSameBitsForAnyNumberOfThreads)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(6000, 0.01, 1)));
  const auto samples = everySecond(cloud.size());
  for (Mode& mode : modes(0.1)) {
    SCOPED_TRACE(mode.name);
    mode.parameters.number_of_threads = 1;
    const SoaBuffer expected = runSteps(mode.parameters, inputOf(cloud, &samples), 3);
    for (const unsigned threads : {2u, 3u, 7u}) {
      mode.parameters.number_of_threads = threads;
      EXPECT_TRUE(sameBits(runSteps(mode.parameters, inputOf(cloud, &samples), 3), expected)) << threads << " threads";
    }
  }
}

TEST(GPF, givesTheSameResultWithAForeignSearch)
{
  const LocalCloud cloud = toLocalCloud(turned(edge(2500, 0.01, 2)));
  for (const Mode& mode : modes(0.12)) {
    const auto built_in = toVectors(runSteps(mode.parameters, inputOf(cloud), 3));
    const auto foreign = toVectors(runSteps(mode.parameters, inputOf(cloud, nullptr, bruteForceSearch), 3));
    for (std::size_t m = 0; m < built_in.size(); ++m)
      ASSERT_LE(distance(built_in[m], foreign[m]), 1e-4 * 0.12) << mode.name;
  }
}

TEST(GPF, givesTheSameResultOnSortedPoints)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(3000, 0.01, 4)));
  const PointIndex index(cloud.points.view());
  SoaBuffer normals(cloud.size());
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    normals.x[k] = cloud.normals.x[index.order()[k]];
    normals.y[k] = cloud.normals.y[index.order()[k]];
    normals.z[k] = cloud.normals.z[index.order()[k]];
  }
  GPFInput sorted;
  sorted.index = &index;
  sorted.normals = normals.view();
  for (const Mode& mode : modes(0.1)) {
    const SoaBuffer expected = runSteps(mode.parameters, inputOf(cloud), 3);
    const SoaBuffer found = runSteps(mode.parameters, sorted, 3);
    for (std::size_t k = 0; k < cloud.size(); ++k)
      ASSERT_EQ(found.x[k], expected.x[index.order()[k]]) << mode.name;
  }
}

TEST(GPF, leavesAnIsolatedPointWhereItIs)
{
  Shape shape = turned(sphere(1500, 0.01, 3));
  append(shape, {3, 3, 3}, {1, 0, 0});
  const LocalCloud cloud = toLocalCloud(shape);
  const std::size_t last = cloud.size() - 1;
  for (const Mode& mode : modes(0.03)) {
    const SoaBuffer after = runSteps(mode.parameters, inputOf(cloud), 4);
    EXPECT_EQ(after.x[last], cloud.points.x[last]) << mode.name;
    EXPECT_EQ(after.y[last], cloud.points.y[last]) << mode.name;
    EXPECT_EQ(after.z[last], cloud.points.z[last]) << mode.name;
    EXPECT_NE(after.x[0], cloud.points.x[0]) << mode.name << " moved nothing";
  }
}

TEST(GPF, leavesACleanPlaneWhereItIs)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(3000)));
  GPFParameters p;
  p.support_radius = 0.15;
  const auto moves = toVectors(displacementsOf([&] {
    GPFState state = gpfInit(p, inputOf(cloud));
    gpfRun(state);
    return state;
  }()));
  for (const Vector3& move : moves)
    ASSERT_LE(distance(move, {0, 0, 0}), 1e-6);
}

TEST(GPF, movesPointsAlongTheirPlaneOnlyWithRepulsion)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(2000)));
  for (const Mode& mode : modes(0.15)) {
    const auto after = toVectors(runSteps(mode.parameters, inputOf(cloud), 1));
    double along = 0, across = 0;
    for (std::size_t m = 0; m < after.size(); ++m) {
      double height = 0;
      for (std::size_t i = 0; i < 3; ++i)
        height += (after[m][i] - cloud.v[m][i]) * cloud.b[m][i];
      across = std::fmax(across, std::abs(height));
      along = std::fmax(along, distance(after[m], cloud.v[m]));
    }
    EXPECT_LE(across, 1e-6) << mode.name;
    EXPECT_EQ(along > 1e-3, mode.parameters.repulsion_weight > 0) << mode.name << " " << along;
  }
}

TEST(GPF, keepsTheOrderOfTheSamples)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(2000, 0.005, 5)));
  // Backwards and with one point twice: the caller's order, not the sorted one, is that of the results.
  std::vector<std::uint32_t> samples = everySecond(cloud.size());
  std::reverse(samples.begin(), samples.end());
  samples.push_back(samples.front());
  for (const Mode& mode : modes(0.1)) {
    SCOPED_TRACE(mode.name);
    GPFState state = gpfInit(mode.parameters, inputOf(cloud, &samples));
    ASSERT_EQ(state.size(), samples.size());
    const SoaBuffer start = positionsOf(state);
    SoaBuffer normals(state.size());
    state.normals(normals.view());
    for (std::size_t m = 0; m < samples.size(); ++m) {
      ASSERT_EQ(start.x[m], cloud.points.x[samples[m]]);
      ASSERT_EQ(start.z[m], cloud.points.z[samples[m]]);
      ASSERT_EQ(normals.y[m], cloud.normals.y[samples[m]]);
    }
    gpfStep(state);
    const auto after = toVectors(positionsOf(state)), moves = toVectors(displacementsOf(state));
    for (std::size_t m = 0; m < samples.size(); ++m) {
      ASSERT_LE(distance(after[m], cloud.v[samples[m]]), 0.2) << "a point far from its seed";
      for (std::size_t i = 0; i < 3; ++i)
        ASSERT_NEAR(cloud.v[samples[m]][i] + moves[m][i], after[m][i], 1.2e-7);
    }
    EXPECT_EQ(state.isolated().size(), samples.size());
  }
}

TEST(GPF, doesNotSeeTheSignOfNormals)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(1500, 0.01, 6)));
  LocalCloud flipped = toLocalCloud(turned(cube(1500, 0.01, 6)));
  for (std::size_t i = 0; i < flipped.size(); i += 3) {
    flipped.normals.x[i] *= -1;
    flipped.normals.y[i] *= -1;
    flipped.normals.z[i] *= -1;
  }
  for (const Mode& mode : modes(0.12))
    EXPECT_TRUE(sameBits(runSteps(mode.parameters, inputOf(cloud), 3), runSteps(mode.parameters, inputOf(flipped), 3))) << mode.name;
}

/** A step on a part of a cloud is right where the part holds everything within the halo. */
TEST(GPF, needsNoPointBeyondItsHalo)
{
  const double h = 0.08;
  const LocalCloud cloud = toLocalCloud(turned(cube(8000, 0.01, 7)));
  for (const Mode& mode : modes(h)) {
    const double halo = gpfHaloWidth(mode.parameters);
    EXPECT_EQ(halo, 2 * h);
    std::vector<std::size_t> part;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.v[i][0] < 0.02 + halo)
        part.push_back(i);
    LocalCloud cut;
    for (const std::size_t i : part) {
      cut.v.push_back(cloud.v[i]);
      cut.b.push_back(cloud.b[i]);
    }
    cut.points = toBuffer(cut.v);
    cut.normals = toBuffer(cut.b);
    const auto whole = toVectors(runSteps(mode.parameters, inputOf(cloud), 1));
    const auto alone = toVectors(runSteps(mode.parameters, inputOf(cut), 1));
    std::size_t owned = 0;
    for (std::size_t k = 0; k < part.size(); ++k)
      if (cut.v[k][0] < 0.02) {
        ++owned;
        ASSERT_LE(distance(whole[part[k]], alone[k]), 1e-6) << mode.name;
      }
    EXPECT_GT(owned, 1000u);
    EXPECT_LT(part.size(), cloud.size());
  }
}

TEST(GPF, stopsWhenNothingMovesAndAtTheMaximum)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(500)));
  GPFParameters p;
  p.support_radius = 0.2;
  p.maximum_iterations = 7;
  const auto iterations = [&] { GPFState state = gpfInit(p, inputOf(cloud)); return gpfRun(state).size(); };
  EXPECT_EQ(iterations(), 1u) << "the first step moves nothing";
  p.convergence_threshold = 0.0;
  EXPECT_EQ(iterations(), 7u);
  p.maximum_iterations = 0;
  EXPECT_EQ(iterations(), 0u);
}

TEST(GPF, canBeCancelledAtEveryReport)
{
  const LocalCloud cloud = toLocalCloud(turned(cube(500, 0.01, 1)));
  GPFParameters p;
  p.support_radius = 0.2;
  p.maximum_iterations = 4;
  p.convergence_threshold = 0;
  std::vector<double> fractions;
  GPFState complete = gpfInit(p, inputOf(cloud));
  gpfRun(complete, [&](double fraction) { fractions.push_back(fraction); return true; });
  EXPECT_EQ(fractions, (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
  for (std::size_t stop = 0; stop < fractions.size(); ++stop) {
    GPFState state = gpfInit(p, inputOf(cloud));
    std::size_t calls = 0;
    EXPECT_THROW(gpfRun(state, [&](double) { return calls++ < stop; }), Cancelled);
    EXPECT_EQ(calls, stop + 1);
  }
}

TEST(GPF, refusesParametersOutsideTheirRange)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [](auto change) {
    GPFParameters p;
    change(p);
    EXPECT_THROW(validate(p), InvalidParameter);
  };
  for (const double bad : {-1.0, nan, infinity}) {
    refused([bad](GPFParameters& p) { p.support_radius = bad; });
    refused([bad](GPFParameters& p) { p.repulsion_weight = bad; });
    refused([bad](GPFParameters& p) { p.outlier_weight = bad; });
    refused([bad](GPFParameters& p) { p.initial_variance = bad; });
    refused([bad](GPFParameters& p) { p.normal_angle = bad; });
    refused([bad](GPFParameters& p) { p.normal_weight_floor = bad; });
    refused([bad](GPFParameters& p) { p.sample_ratio = bad; });
    refused([bad](GPFParameters& p) { p.convergence_threshold = bad; });
  }
  refused([](GPFParameters& p) { p.repulsion_weight = 0.51; });
  refused([](GPFParameters& p) { p.outlier_weight = 1.0; });
  refused([](GPFParameters& p) { p.normal_angle = 0.0; });
  refused([](GPFParameters& p) { p.sample_ratio = 0.0; });
  refused([](GPFParameters& p) { p.maximum_iterations = 10001; });
  EXPECT_NO_THROW(validate(GPFParameters{}));
  EXPECT_NO_THROW(validate(GPFParameters::paper()));
}

TEST(GPF, refusesAnUnsetRadiusAndSamplesThatDoNotExist)
{
  const LocalCloud cloud = toLocalCloud(plane(10));
  EXPECT_THROW(gpfInit(GPFParameters{}, inputOf(cloud)), InvalidParameter);
  GPFParameters p;
  p.support_radius = 0.1;
  const std::vector<std::uint32_t> samples = {1, 10};
  EXPECT_THROW(gpfInit(p, inputOf(cloud, &samples)), InvalidParameter);
}

TEST(GPF, refusesARadiusThatWouldTakeForever)
{
  const LocalCloud cloud = toLocalCloud(sphere(160000, 0, 1));
  GPFParameters p;
  p.support_radius = 2.0; // everything is everything's neighbour: 2.6e10 pairs
  p.merge_above = 0;
  try {
    gpfInit(p, inputOf(cloud));
    FAIL() << "not refused";
  } catch (const ExcessiveWork& e) {
    for (const char* part : {"gpf.support_radius", "about 160000 neighbours", "130 billion pairs", " s and ", " MB", "smaller radius"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
  p.merge_above = 200; // means make the work bearable
  GPFState state = gpfInit(p, inputOf(cloud));
  EXPECT_NO_THROW(gpfStep(state));
}

TEST(GPF, takesDegenerateClouds)
{
  for (const std::size_t size : {1u, 2u, 3u, 17u})
    for (const Mode& mode : modes(0.5)) {
      Shape shape;
      for (std::size_t i = 0; i < size; ++i) // all in one place: no pair has a direction
        append(shape, {0.1, 0.2, 0.3}, {0, 0, 1});
      const LocalCloud cloud = toLocalCloud(shape);
      EXPECT_TRUE(sameBits(runSteps(mode.parameters, inputOf(cloud), 3), cloud.points)) << mode.name << " " << size;
    }
  GPFParameters p;
  p.support_radius = 0.1;
  const LocalCloud nothing = toLocalCloud(Shape{});
  GPFState state = gpfInit(p, inputOf(nothing));
  EXPECT_EQ(gpfStep(state).mean_movement, 0.0);
  EXPECT_EQ(state.size(), 0u);
}

} // namespace
} // namespace pcl_gpf::test
