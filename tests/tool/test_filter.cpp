// SPDX-License-Identifier: BSD-3-Clause
// What the command filter gives on good data.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

TEST(ToolFilter, MakesANoisyCubeSmootherAndKeepsItsPoints)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 20000);
  const ToolRun run = runTool({"filter", input, "-o", folder / "out.pcd", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  const CloudFile before = readCloud(input);
  const CloudFile after = readCloud(folder / "out.pcd");
  ASSERT_EQ(after.size(), before.size());
  EXPECT_TRUE(after.hasNormals());
  EXPECT_LT(distanceToCube(after), 0.6 * distanceToCube(before));
  EXPECT_NE(run.err.find("radius"), std::string::npos);
  EXPECT_NE(run.err.find("estimated"), std::string::npos);
}

TEST(ToolFilter, ReportHasParametersIterationsSecondsMemoryAndMovement)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd");
  const ToolRun run = runTool({"filter", input, "-o", folder / "out.pcd", "--json", "-q", "--radius", "5x", "--iterations", "3",
                               "--convergence-threshold", "0", "--bilateral-radius", "2%"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const json report = json::parse(run.out);
  const json& parameters = report["parameters"];
  EXPECT_EQ(parameters["radius"]["origin"], "user");
  EXPECT_EQ(parameters["radius"]["reason"], "5x");
  EXPECT_NEAR(parameters["radius"]["value"].get<double>(), 5.0 * report["scale"]["spacing"].get<double>(), 1e-6);
  EXPECT_NEAR(parameters["bilateral-radius"]["value"].get<double>(), 0.02 * report["scale"]["diagonal"].get<double>(), 1e-6);
  EXPECT_EQ(parameters["normal-radius"]["origin"], "estimated");
  EXPECT_NE(parameters["normal-radius"]["reason"], "");
  EXPECT_EQ(parameters["iterations"], (json{{"value", 3}, {"origin", "user"}, {"reason", ""}}));
  EXPECT_EQ(parameters["data-term"], (json{{"value", "symmetric"}, {"origin", "default"}, {"reason", "the paper's point-to-plane term inflates curved parts"}}));
  ASSERT_EQ(report["iterations"].size(), 3u);
  for (const json& iteration : report["iterations"]) {
    EXPECT_GT(iteration["sigma"].get<double>(), 0.0);
    EXPECT_GT(iteration["movement"].get<double>(), 0.0);
  }
  double parts = 0.0;
  for (const char* part : {"read", "normals", "bilateral", "filter", "write"})
    parts += report["seconds"][part].get<double>();
  EXPECT_LE(parts, report["seconds"]["total"].get<double>());
  EXPECT_GT(report["peak_bytes"].get<std::size_t>(), std::size_t{1} << 20);
  EXPECT_EQ(report["warnings"], json::array());
  EXPECT_EQ(report["points"], 3000);

  // The movement summary is that of the files.
  const CloudCoordinates a = readCloud(input).coordinates();
  const CloudCoordinates b = readCloud(folder / "out.pcd").coordinates();
  std::vector<double> moved;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    moved.push_back(std::hypot(b.x[i] - a.x[i], b.y[i] - a.y[i], b.z[i] - a.z[i]));
  std::sort(moved.begin(), moved.end());
  EXPECT_NEAR(report["movement"]["max"].get<double>(), moved.back(), 1e-12);
  EXPECT_NEAR(report["movement"]["p95"].get<double>(), moved[2849], 1e-12);
}

TEST(ToolFilter, ZeroIterationsCopyThePoints)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd");
  ASSERT_EQ(runTool({"filter", input, "-o", folder / "out.pcd", "--iterations", "0", "--no-normals", "--outliers", "keep"}).exit_code, 0);
  EXPECT_EQ(readBytes(folder / "out.pcd"), readBytes(input));
}

TEST(ToolFilter, SamplesAreASeededSubsetWithTheirFields)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(2000, 0.005, 11));
  const int label = cloud.addField("label", FieldType::UInt32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, label, static_cast<double>(i));
  save(cloud, folder / "in.pcd");
  const auto labels = [&](const std::string& samples, const std::string& seed) {
    const ToolRun run = runTool({"filter", folder / "in.pcd", "-o", folder / "out.pcd", "--overwrite", "--samples", samples, "--seed",
                                 seed, "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const CloudFile result = readCloud(folder / "out.pcd");
    return result.column(result.findField("label"));
  };
  const std::vector<double> half = labels("50%", "1");
  EXPECT_EQ(half.size(), 1000u);
  EXPECT_TRUE(std::is_sorted(half.begin(), half.end()));
  EXPECT_EQ(labels("1000", "1"), half);
  EXPECT_NE(labels("50%", "2"), half);
  EXPECT_EQ(labels("123", "1").size(), 123u);
  EXPECT_EQ(labels("100%", "1").size(), 2000u);
}

TEST(ToolFilter, ReportsTheRoundsOfGapFilling)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd");
  const ToolRun run = runTool({"filter", input, "-o", folder / "out.pcd", "--normal-weight-floor", "1", "--gap-filling", "2", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  ASSERT_EQ(report["gap_iterations"].size(), 2u);
  EXPECT_GT(report["gap_iterations"][0]["max_movement"], 0.0);
  EXPECT_EQ(report["parameters"]["gap-filling"]["value"], 2);
  EXPECT_EQ(report["parameters"]["two-scales"]["value"], "off");
  EXPECT_NE(run.err.find("2 rounds of gap filling"), std::string::npos) << run.err;
  EXPECT_EQ(runTool({"filter", input, "-o", folder / "x.pcd", "--gap-filling", "101"}).exit_code, 2);
}

TEST(ToolFilter, PaperPresetIsAlgorithmOne)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 1500);
  const ToolRun run =
      runTool({"filter", input, "-o", folder / "out.pcd", "--preset", "paper", "--iterations", "4", "--json", "-q"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  EXPECT_EQ(report["points"], 750);
  EXPECT_EQ(report["parameters"]["variance-update"], (json{{"value", "paper"}, {"origin", "preset"}, {"reason", ""}}));
  EXPECT_EQ(report["parameters"]["iterations"]["origin"], "user");
  EXPECT_EQ(report["iterations"][0]["variance"].get<double>(), 0.004);
  EXPECT_EQ(report["iterations"].size(), 4u);
}

TEST(ToolFilter, NormalsOfTheFileAreUsedAndReplaced)
{
  TemporaryFolder folder;
  const Shape shape = cube(3000, 0.01, 5);
  CloudFile cloud = toCloudFile(shape);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int field = cloud.addField(axis == 0 ? "normal_x" : axis == 1 ? "normal_y" : "normal_z", FieldType::Float32);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.setValue(i, field, 50.0 * shape.normals[i][axis]);
  }
  save(cloud, folder / "in.ply");
  const auto report = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"filter", folder / "in.ply", "-o", folder / "out.ply", "--overwrite", "--json", "-q"});
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out);
  };
  EXPECT_EQ(report({})["estimated_normals"], 0);
  const CloudFile filtered = readCloud(folder / "out.ply");
  EXPECT_EQ(filtered.fields.size(), 7u);
  EXPECT_EQ(filtered.fields.back().name, "outlier");
  for (std::size_t i = 0; i < filtered.size(); i += 100)
    EXPECT_NEAR(std::hypot(filtered.value(i, 3), filtered.value(i, 4), filtered.value(i, 5)), 1.0, 1e-5);
  EXPECT_EQ(report({"--normals", "estimate"})["estimated_normals"], 3000);
  report({"--no-normals"});
  EXPECT_EQ(readCloud(folder / "out.ply").column(3), cloud.column(3));

  saveNoisyCube(folder / "bare.ply", 500);
  EXPECT_EQ(runTool({"filter", folder / "bare.ply", "-o", folder / "x.ply", "--normals", "file"}).exit_code, 5);
}

TEST(ToolFilter, IntegerCoordinatesBecomeDouble)
{
  TemporaryFolder folder;
  CloudFile cloud;
  const Shape shape = cube(3000, 0.01, 5);
  cloud.width = 3000;
  for (const char* axis : {"x", "y", "z"})
    cloud.addField(axis, FieldType::Int32);
  for (std::size_t i = 0; i < shape.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      cloud.setCoordinate(i, axis, 10000.0 * shape.points[i][static_cast<std::size_t>(axis)]);
  save(cloud, folder / "in.ply");
  ASSERT_EQ(runTool({"filter", folder / "in.ply", "-o", folder / "out.ply"}).exit_code, 0);
  const CloudFile result = readCloud(folder / "out.ply");
  EXPECT_EQ(result.fields[0].type, FieldType::Float64);
  EXPECT_EQ(result.size(), 3000u);
}

} // namespace
} // namespace pcl_gpf::test
