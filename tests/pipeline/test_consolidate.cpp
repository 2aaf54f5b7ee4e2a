// SPDX-License-Identifier: BSD-3-Clause
// The chain is its stages one after the other: same bits, rows of the input, one frame.
#include "support/implicit_shapes.h"
#include "support/shapes.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/consolidate.h>
#include <pcl_gpf/pipeline/orient.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pcl_gpf::test {
namespace {

constexpr double kNoise = 0.003; ///< standard deviation
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/** A noisy sphere of radius 1 / 2 far from the origin, with two rows that are not finite. */
struct Cloud {
  explicit Cloud(std::size_t count = 4000)
  {
    const Shape shape = sphere(count, kNoise);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      x.push_back(shape.points[i][0] + kOffset[0]);
      y.push_back(shape.points[i][1] + kOffset[1]);
      z.push_back(shape.points[i][2] + kOffset[2]);
      nx.push_back(static_cast<float>(shape.normals[i][0]));
      ny.push_back(static_cast<float>(shape.normals[i][1]));
      nz.push_back(static_cast<float>(shape.normals[i][2]));
    }
    if (count > 100)
      x[7] = y[90] = kNaN;
  }
  DenoiseInput
  input(bool normals = false) const
  {
    return normals ? DenoiseInput{x.data(), y.data(), z.data(), x.size(), nx.data(), ny.data(), nz.data()}
                   : DenoiseInput{x.data(), y.data(), z.data(), x.size()};
  }
  static double radius(double px, double py, double pz) { return std::hypot(px - kOffset[0], py - kOffset[1], pz - kOffset[2]); }

  static constexpr double kOffset[3] = {691000, 5335000, 500};
  std::vector<double> x, y, z;
  std::vector<float> nx, ny, nz;
};

ConsolidationParameters
allStages()
{
  ConsolidationParameters p;
  p.upsample = true;
  p.meshing.rimls.resolution = 40;
  return p;
}

TEST(Consolidate, equalsItsStagesOneAfterTheOther)
{
  const Cloud cloud;
  ConsolidationParameters p = allStages();
  p.upsample = false;
  const ConsolidationResult result = consolidate(cloud.input(), p);

  DenoiseResult filtered = denoise(cloud.input(), p.denoise);
  const OrientResult oriented = orientCloud({filtered.x.data(), filtered.y.data(), filtered.z.data(), filtered.x.size(),
                                             filtered.normal_x.data(), filtered.normal_y.data(), filtered.normal_z.data()}, {});
  MeshParameters meshing = p.meshing;
  meshing.orientation = MeshOrientation::Keep;
  const MeshResult mesh = meshCloud({filtered.x.data(), filtered.y.data(), filtered.z.data(), filtered.x.size(),
                                     oriented.normal_x.data(), oriented.normal_y.data(), oriented.normal_z.data()}, meshing);
  EXPECT_EQ(result.points.x, filtered.x);
  EXPECT_EQ(result.points.source_rows, filtered.sample_indices);
  EXPECT_EQ(result.points.normal_z, oriented.normal_z);
  EXPECT_EQ(result.mesh.vertices, mesh.vertices);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
  ASSERT_EQ(result.mesh.source_rows.size(), mesh.source_rows.size());
  for (std::size_t v = 0; v < mesh.source_rows.size(); ++v)
    ASSERT_EQ(result.mesh.source_rows[v], filtered.sample_indices[mesh.source_rows[v]]);
  EXPECT_EQ(result.non_finite_points, 2u);
  EXPECT_EQ(result.estimated_normals, 3998u);
  EXPECT_EQ(result.upsampled.size(), 0u);
}

TEST(Consolidate, upsamplesAndMeshesASphereThatIsClosedAndOutward)
{
  const Cloud cloud;
  const ConsolidationResult result = consolidate(cloud.input(), allStages());
  EXPECT_EQ(result.upsampled.size(), 2 * result.points.size());
  EXPECT_TRUE(std::equal(result.points.x.begin(), result.points.x.end(), result.upsampled.x.begin()));
  EXPECT_EQ(result.mesh.points, result.upsampled.size());
  EXPECT_EQ(result.mesh.open_edges, 0u);
  EXPECT_EQ(result.mesh.components, 1u);
  double squares = 0.0;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    squares += std::pow(Cloud::radius(result.points.x[i], result.points.y[i], result.points.z[i]) - 0.5, 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(result.points.size())), 0.5 * kNoise);
  for (std::size_t v = 0; v < result.mesh.source_rows.size(); ++v) {
    const double* p = &result.mesh.vertices[3 * v];
    ASSERT_NEAR(Cloud::radius(p[0], p[1], p[2]), 0.5, 0.5 * result.mesh.rimls.cell_size);
    ASSERT_GT((p[0] - Cloud::kOffset[0]) * static_cast<double>(result.mesh.normals[3 * v]) +
                  (p[1] - Cloud::kOffset[1]) * static_cast<double>(result.mesh.normals[3 * v + 1]) +
                  (p[2] - Cloud::kOffset[2]) * static_cast<double>(result.mesh.normals[3 * v + 2]),
              0.4);
    const std::uint32_t row = result.mesh.source_rows[v];
    ASSERT_LT(std::hypot(cloud.x[row] - p[0], cloud.y[row] - p[1], cloud.z[row] - p[2]), 0.1);
  }
}

TEST(Consolidate, stagesThatAreNotChosenLeaveTheInputAlone)
{
  const Cloud cloud;
  ConsolidationParameters p = allStages();
  p.filter = p.upsample = p.orient = false;
  const ConsolidationResult meshed = consolidate(cloud.input(true), p);
  EXPECT_EQ(meshed.points.size(), 3998u);
  for (std::size_t i = 0; i < meshed.points.size(); ++i) {
    ASSERT_EQ(meshed.points.x[i], cloud.x[meshed.points.source_rows[i]]);
    ASSERT_EQ(meshed.points.normal_y[i], cloud.ny[meshed.points.source_rows[i]]);
  }
  EXPECT_EQ(meshed.estimated_normals, 0u);

  p = ConsolidationParameters();
  p.filter = p.orient = p.mesh = false;
  p.normals = true;
  const ConsolidationResult normals = consolidate(cloud.input(true), p);
  EXPECT_EQ(normals.points.x, meshed.points.x);
  EXPECT_EQ(normals.estimated_normals, 3998u);
  EXPECT_NE(normals.points.normal_x, meshed.points.normal_x);
  EXPECT_TRUE(normals.mesh.triangles.empty());
}

TEST(Consolidate, tellsEveryStageAndCanBeCancelledInEach)
{
  const Cloud cloud(1000);
  std::vector<std::string> stages;
  double whole = 0.0, largest_step = 0.0;
  consolidate(cloud.input(), allStages(), [&](const std::string& stage, double fraction) {
    EXPECT_GE(fraction, whole) << stage;
    largest_step = std::max(largest_step, fraction - whole);
    whole = fraction;
    if (stages.empty() || stages.back() != stage)
      stages.push_back(stage);
    return true;
  });
  EXPECT_EQ(whole, 1.0);
  EXPECT_LT(largest_step, 0.25) << "no stage takes most of the bar at once";
  for (const char* stage : {"normals", "bilateral", "filter", "orient", "upsampling", "mesh"}) {
    EXPECT_EQ(std::count(stages.begin(), stages.end(), stage), 1) << stage;
    EXPECT_THROW(consolidate(cloud.input(), allStages(), [&](const std::string& name, double) { return name != stage; }), Cancelled) << stage;
  }
}

TEST(Consolidate, theProgressOfTheWholeNeverFallsWhateverComesBetween)
{
  ConsolidationParameters p;
  p.filter = false; // orient makes the normals that are missing, which nobody expects
  p.meshing.rimls.resolution = 30;
  double whole = 0.0;
  const auto watch = [&whole](const std::string& stage, double fraction) {
    EXPECT_GE(fraction, whole) << stage;
    whole = fraction;
    return true;
  };
  consolidate(Cloud(1000).input(), p, watch);
  EXPECT_EQ(whole, 1.0);

  Cloud scattered(4000); // a second run of the filter
  for (std::size_t i = 0; i < 4000; i += 20) {
    const double factor = 1.04 + 2e-5 * static_cast<double>(i);
    scattered.x[i] = Cloud::kOffset[0] + factor * (scattered.x[i] - Cloud::kOffset[0]);
    scattered.y[i] = Cloud::kOffset[1] + factor * (scattered.y[i] - Cloud::kOffset[1]);
    scattered.z[i] = Cloud::kOffset[2] + factor * (scattered.z[i] - Cloud::kOffset[2]);
  }
  whole = 0.0;
  p = ConsolidationParameters();
  p.mesh = p.orient = false;
  const ConsolidationResult result = consolidate(scattered.input(), p, watch);
  EXPECT_TRUE(result.denoise.repeated);
  EXPECT_EQ(whole, 1.0);
}

TEST(Consolidate, doesNotDependOnTheNumberOfThreads)
{
  const Cloud cloud(2000);
  ConsolidationParameters one = allStages(), four = allStages();
  one.number_of_threads = 1;
  four.number_of_threads = 4;
  const ConsolidationResult a = consolidate(cloud.input(), one), b = consolidate(cloud.input(), four);
  EXPECT_EQ(a.upsampled.x, b.upsampled.x);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
}

TEST(Consolidate, refusesBeforeTheWork)
{
  const Cloud cloud;
  bool worked = false;
  const StageProgress watch = [&worked](const std::string&, double) { return worked = true; };
  ConsolidationParameters none = allStages(), fine = allStages(), few = allStages(), blind = allStages(), range = allStages();
  none.filter = none.orient = none.upsample = none.mesh = false;
  fine.meshing.rimls.resolution = 60000;
  few.upsampling.edge_aware.target_count = 100;
  blind.filter = blind.orient = blind.upsample = false;
  range.denoise.bilateral.angle = -1;
  EXPECT_THROW(consolidate(cloud.input(), none, watch), InvalidParameter);
  EXPECT_THROW(consolidate(cloud.input(), fine, watch), ExcessiveWork);
  EXPECT_THROW(consolidate(cloud.input(), few, watch), InvalidParameter);
  EXPECT_THROW(consolidate(cloud.input(), blind, watch), InvalidParameter);
  EXPECT_THROW(consolidate(cloud.input(), range, watch), InvalidParameter);
  range = allStages();
  range.viewpoint = {{0, kNaN, 0}};
  EXPECT_THROW(consolidate(cloud.input(), range, watch), InvalidParameter);
  for (const std::size_t count : {0u, 1u, 2u, 3u}) {
    const Cloud small(count);
    EXPECT_THROW(consolidate(small.input(), allStages(), watch), UnsuitableData) << count;
  }
  Cloud same(50);
  std::fill(same.x.begin(), same.x.end(), 1.0);
  std::fill(same.y.begin(), same.y.end(), 2.0);
  std::fill(same.z.begin(), same.z.end(), 3.0);
  EXPECT_THROW(consolidate(same.input(), allStages(), watch), UnsuitableData);
  Cloud line(50);
  for (std::size_t i = 0; i < 50; ++i) {
    line.x[i] = 0.5 * static_cast<double>(i);
    line.y[i] = -line.x[i];
    line.z[i] = 7.0;
  }
  ConsolidationParameters dense = allStages();
  dense.mesh = false;
  EXPECT_THROW(consolidate(line.input(), allStages(), watch), UnsuitableData);
  EXPECT_THROW(consolidate(line.input(), dense, watch), UnsuitableData);
  EXPECT_FALSE(worked);
}

} // namespace
} // namespace pcl_gpf::test
