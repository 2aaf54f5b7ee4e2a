// SPDX-License-Identifier: BSD-3-Clause
// What the commands info, normals and convert give on good data, and how streams are used.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

TEST(ToolInfo, TellsWhatIsInAFile)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(plane(1000, 0.0, 3), FieldType::Float64, {10, 20, 30});
  cloud.setCoordinate(5, 0, std::nan(""));
  for (int axis = 0; axis < 3; ++axis)
    cloud.setCoordinate(7, axis, cloud.value(6, axis));
  cloud.viewpoint = {1, 2, 3, 1, 0, 0, 0};
  cloud.addField("label", FieldType::UInt16, 2);
  save(cloud, folder / "a.pcd");

  const ToolRun run = runTool({"info", folder / "a.pcd", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info["schema"], "pcl_gpf.info/1");
  EXPECT_EQ(info["points"], 1000);
  EXPECT_EQ(info["finite"], 999);
  EXPECT_EQ(info["duplicates"], 1);
  EXPECT_EQ(info["width"], 1000);
  EXPECT_EQ(info["height"], 1);
  EXPECT_EQ(info["format"], "PCD binary");
  EXPECT_EQ(info["fields"].size(), 4u);
  EXPECT_EQ(info["fields"][3], (json{{"name", "label"}, {"type", "uint16"}, {"count", 2}}));
  EXPECT_EQ(info["viewpoint"], (json{1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(info["precision"]["verdict"], "fine");
  // The mean spacing of N even points on a unit square is 1 / sqrt(N).
  EXPECT_NEAR(info["spacing"].get<double>(), 1.0 / std::sqrt(1000.0), 0.006);
  EXPECT_NEAR(info["noise"].get<double>(), 0.0, 1e-6);
  double sum = 0.0, least = 1e9;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i != 5) {
      sum += cloud.value(i, 1);
      least = std::min(least, cloud.value(i, 1));
    }
  EXPECT_NEAR(info["mean"][1].get<double>(), sum / 999.0, 1e-12);
  EXPECT_EQ(info["min"][1].get<double>(), least);
}

TEST(ToolInfo, TextHasTheSameFigures)
{
  TemporaryFolder folder;
  const std::string cloud = saveNoisyCube(folder / "a.ply", 500);
  const ToolRun run = runTool({"info", cloud});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("500 (500 x 1), 500 finite, 0 duplicates"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("x  float32"), std::string::npos) << run.out;
}

TEST(ToolInfo, EmptyCloudIsNoError)
{
  TemporaryFolder folder;
  writeBytes(folder / "empty.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                                   "property float z\nend_header\n");
  const ToolRun run = runTool({"info", folder / "empty.ply", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json info = json::parse(run.out);
  EXPECT_EQ(info["points"], 0);
  EXPECT_EQ(info["finite"], 0);
  EXPECT_TRUE(info["mean"].is_null());
}

TEST(ToolInfo, ReportGoesToAFileAndItsNameMayBeAWordOfItsOwn)
{
  TemporaryFolder folder;
  const std::string cloud = saveNoisyCube(folder / "a.ply", 100);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"info", cloud, "--overwrite", "--json=" + (folder / "r.json")},
        std::vector<std::string>{"info", cloud, "--overwrite", "--json", folder / "r.json"}}) {
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(json::parse(readBytes(folder / "r.json"))["points"], 100);
  }
}

TEST(ToolNormals, AddsUnitNormalsOfThePlane)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(plane(2000, 0.0, 2));
  cloud.setCoordinate(3, 1, std::nan(""));
  save(cloud, folder / "in.pcd");
  const ToolRun run = runTool({"normals", folder / "in.pcd", "-o", folder / "out.pcd"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CloudFile result = readCloud(folder / "out.pcd");
  ASSERT_TRUE(result.hasNormals());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double z = result.value(i, result.findField("normal_z"));
    if (i == 3)
      EXPECT_TRUE(std::isnan(z));
    else
      EXPECT_NEAR(std::abs(z), 1.0, 1e-5);
  }
  EXPECT_EQ(result.column(0), cloud.column(0));
  for (const char* value : {"0", "2"})
    EXPECT_EQ(runTool({"normals", folder / "in.pcd", "-o", folder / "out.pcd", "--overwrite", "--bilateral-iterations", value, "--radius",
                       "3x", "--k", "12"})
                  .exit_code,
              0);
}

TEST(ToolConvert, EveryFormatAndBackKeepsTheCoordinates)
{
  TemporaryFolder folder;
  const CloudFile cloud = toCloudFile(cube(500, 0.01, 9), FieldType::Float64, {691000, 5335000, 500});
  save(cloud, folder / "in.pcd");
  for (const char* format : {"pcd-ascii", "pcd-binary", "pcd-compressed", "ply-ascii", "ply-le", "ply-be", "xyz"}) {
    const std::string name = folder / (std::string("a.") + (format == std::string("xyz") ? "xyz" : std::string(format).substr(0, 3)));
    const ToolRun run = runTool({"convert", folder / "in.pcd", "-o", name, "--format", format, "--overwrite"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const CloudFile result = readCloud(name);
    EXPECT_EQ(result.coordinates().y, cloud.coordinates().y) << format;
  }
}

TEST(ToolConvert, OffsetIsAddedInDoubleBeforeRounding)
{
  TemporaryFolder folder;
  const Shape shape = cube(500, 0.01, 9);
  save(toCloudFile(shape, FieldType::Float64, {691000, 5335000, 500}), folder / "utm.ply");
  const ToolRun run = runTool({"convert", folder / "utm.ply", "-o", folder / "local.ply", "--offset", "-691000,-5335000,-500",
                               "--precision", "float"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CloudFile result = readCloud(folder / "local.ply");
  EXPECT_EQ(result.fields[0].type, FieldType::Float32);
  for (std::size_t i = 0; i < result.size(); ++i)
    EXPECT_NEAR(result.value(i, 1), shape.points[i][1], 1e-8 + 1e-9 * 5335000 * 0.25);
  const ToolRun coarse = runTool({"convert", folder / "utm.ply", "-o", folder / "coarse.ply", "--precision", "float"});
  EXPECT_EQ(coarse.exit_code, 0);
  EXPECT_NE(coarse.err.find("warning: coordinates are quantised"), std::string::npos) << coarse.err;
}

TEST(ToolStreams, ReadsStandardInputAndWritesStandardOutput)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.ply", 800);
  RunSetup setup;
  setup.standard_input = input;
  const ToolRun converted = runTool({"convert", "-", "-o", "-", "--format", "pcd-binary"}, setup);
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  writeBytes(folder / "copy.pcd", converted.out);
  EXPECT_EQ(readCloud(folder / "copy.pcd").coordinates().x, readCloud(input).coordinates().x);
  const ToolRun filtered = runTool({"filter", "-", "-o", "-", "--json=" + (folder / "r.json")}, setup);
  ASSERT_EQ(filtered.exit_code, 0) << filtered.err;
  writeBytes(folder / "filtered.ply", filtered.out);
  EXPECT_EQ(readCloud(folder / "filtered.ply").size(), 800u);
}

TEST(ToolStreams, ProgressLinesAppearOnlyWhenAskedForAndBarsNeverInFiles)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.ply");
  const auto messages = [&](const std::string& mode) {
    return runTool({"filter", input, "-o", folder / "out.ply", "--overwrite", "--progress", mode}).err;
  };
  EXPECT_NE(messages("plain").find(" %"), std::string::npos);
  EXPECT_EQ(messages("none").find(" %"), std::string::npos);
  EXPECT_EQ(messages("auto").find('\r'), std::string::npos);
}

} // namespace
} // namespace pcl_gpf::test
