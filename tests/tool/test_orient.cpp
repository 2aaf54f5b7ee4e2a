// SPDX-License-Identifier: BSD-3-Clause
// The command orient: which way normals point, with and without a viewpoint, and what the report says.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

/** \brief Adds the exact normals, every third turned round. */
CloudFile
withMixedNormals(CloudFile cloud, const Shape& shape)
{
  const char* names[3] = {"normal_x", "normal_y", "normal_z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int field = cloud.addField(names[axis], FieldType::Float32);
    for (std::size_t i = 0; i < shape.size(); ++i)
      cloud.setValue(i, field, (i % 3 == 0 ? -1 : 1) * shape.normals[i][axis]);
  }
  return cloud;
}

/** \brief Points whose normal does not point with the exact one. */
std::size_t
countWrong(const CloudFile& cloud, const Shape& shape)
{
  const int x = cloud.findField("normal_x"), y = cloud.findField("normal_y"), z = cloud.findField("normal_z");
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    wrong += !(cloud.value(i, x) * shape.normals[i][0] + cloud.value(i, y) * shape.normals[i][1] +
                   cloud.value(i, z) * shape.normals[i][2] >
               0);
  return wrong;
}

TEST(ToolOrient, ClosedCloudWithNormalsPointsOutwardAndKeepsItsPoints)
{
  TemporaryFolder folder;
  const Shape shape = sphere(2000, 0.002);
  const CloudFile cloud = withMixedNormals(toCloudFile(shape, FieldType::Float64, {691000, 5335000, 500}), shape);
  save(cloud, folder / "in.pcd");
  const ToolRun run = runTool({"orient", folder / "in.pcd", "-o", folder / "out.pcd", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CloudFile result = readCloud(folder / "out.pcd");
  EXPECT_EQ(countWrong(result, shape), 0u);
  for (int field = 0; field < 3; ++field)
    EXPECT_EQ(result.column(field), cloud.column(field));
  const json report = json::parse(readBytes(folder / "r.json"));
  EXPECT_EQ(report["schema"], "pcl_gpf.orient/1");
  EXPECT_EQ(report["input"]["normals"], "file");
  EXPECT_EQ(report["flipped"], 667);
  EXPECT_EQ(report["parts"], (json{{"all", 1}, {"viewpoint", 0}, {"outward", 1}, {"root", 0}}));
  EXPECT_TRUE(report["viewpoint"].is_null());
  EXPECT_EQ(report["votes"]["all"], 32000);
  EXPECT_EQ(report["estimated_normals"], 0);
}

TEST(ToolOrient, CloudWithoutNormalsGetsThemFirstAndItIsSaid)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.ply", 5000, 0.005);
  const ToolRun run = runTool({"orient", input, "-o", folder / "out.ply", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("the input has no normals"), std::string::npos) << run.err;
  EXPECT_EQ(json::parse(readBytes(folder / "r.json"))["input"]["normals"], "estimated");
  const CloudFile result = readCloud(folder / "out.ply");
  ASSERT_TRUE(result.hasNormals());
  const char* names[3] = {"normal_x", "normal_y", "normal_z"};
  std::size_t inward = 0;
  for (std::size_t i = 0; i < result.size(); ++i) { // beside an edge a normal may be that of either face
    double largest = 0, outward = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = result.value(i, result.findField(names[axis]));
      if (std::fabs(n) > std::fabs(largest)) {
        largest = n;
        outward = result.value(i, axis) - 0.5;
      }
    }
    inward += !(largest * outward > 0);
  }
  EXPECT_LE(inward, 5u);
}

TEST(ToolOrient, ViewpointOfTheFileOrOfTheUser)
{
  TemporaryFolder folder;
  const Shape square = plane(500);
  CloudFile cloud = withMixedNormals(toCloudFile(square), square);
  cloud.viewpoint = {0.5, 0.5, -3, 1, 0, 0, 0};
  save(cloud, folder / "in.pcd");
  const auto wrongWith = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"orient", folder / "in.pcd", "-o", folder / "out.pcd", "--overwrite"};
    all.insert(all.end(), words.begin(), words.end());
    const ToolRun run = runTool(all);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return countWrong(readCloud(folder / "out.pcd"), square);
  };
  EXPECT_EQ(wrongWith({}), 500u) << "the sensor of the file is below";
  EXPECT_EQ(wrongWith({"--viewpoint", "auto"}), 500u);
  EXPECT_EQ(wrongWith({"--viewpoint", "none"}), 0u) << "the highest point looks up";
  EXPECT_EQ(wrongWith({"--viewpoint", "0,0,5"}), 0u);
  EXPECT_EQ(wrongWith({"--viewpoint", "0,0,-5"}), 500u);
}

TEST(ToolOrient, PointsWithoutPositionOrNormal)
{
  TemporaryFolder folder;
  const Shape shape = sphere(1000);
  CloudFile cloud = withMixedNormals(toCloudFile(shape), shape);
  cloud.setCoordinate(3, 1, std::nan(""));
  cloud.setValue(5, cloud.findField("normal_x"), std::nan(""));
  save(cloud, folder / "in.pcd");
  const ToolRun run = runTool({"orient", folder / "in.pcd", "-o", folder / "out.pcd"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("warning: 1 points had no usable normal"), std::string::npos) << run.err;
  const CloudFile result = readCloud(folder / "out.pcd");
  EXPECT_TRUE(std::isnan(result.value(3, result.findField("normal_z"))));
  EXPECT_EQ(countWrong(result, shape), 1u) << "only the point without a position";
}

TEST(ToolOrient, WrongOptionsAndUnusableCloudsAreRefused)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.ply", 500);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--viewpoint", "1,2"}, std::vector<std::string>{"--neighbors", "2"},
        std::vector<std::string>{"--gap", "-1"}, std::vector<std::string>{"--viewpoint", "nan,0,0"}}) {
    std::vector<std::string> all{"orient", input, "-o", folder / "out.ply"};
    all.insert(all.end(), words.begin(), words.end());
    const ToolRun run = runTool(all);
    EXPECT_EQ(run.exit_code, 2) << words[0] << " " << words[1];
    EXPECT_NE(run.err.find(words[0]), std::string::npos) << run.err;
  }
  CloudFile pile = toCloudFile(cube(1));
  save(pile.select(std::vector<std::size_t>(10, 0)), folder / "pile.ply");
  EXPECT_EQ(runTool({"orient", folder / "pile.ply", "-o", folder / "out.ply"}).exit_code, 5);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"in.ply", "pile.ply"}));
}

} // namespace
} // namespace pcl_gpf::test
