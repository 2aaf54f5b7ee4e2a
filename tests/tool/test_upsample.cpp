// SPDX-License-Identifier: BSD-3-Clause
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace pcl_gpf::test {
namespace {

/** A cube with ids far from the origin, in double, with a hole in row 7. */
CloudFile
surveyedCube(std::size_t count = 2000)
{
  CloudFile cloud = toCloudFile(cube(count, 0.001, 3), FieldType::Float64, {500000, 5400000, 300});
  const int id = cloud.addField("id", FieldType::UInt32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, id, static_cast<double>(i));
  cloud.setCoordinate(7, 1, std::numeric_limits<double>::quiet_NaN());
  return cloud;
}

TEST(UpsampleCommand, keepsEveryRowAndAddsCopiesOfParentsInDouble)
{
  const TemporaryFolder folder;
  const CloudFile before = surveyedCube();
  save(before, folder / "in.pcd");
  const ToolRun run = runTool({"upsample", folder / "in.pcd", "-o", folder / "out.pcd", "--factor", "3", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("1999 normals were estimated"), std::string::npos) << run.err;
  CloudFile after = readCloud(folder / "out.pcd");
  ASSERT_EQ(after.size(), 2000u + 2u * 1999u);
  EXPECT_TRUE(after.hasNormals());
  const CloudCoordinates old_points = before.coordinates(), points = after.coordinates();
  const std::vector<double> ids = after.column(after.findField("id"));
  double farthest = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (i < before.size()) {
      EXPECT_EQ(ids[i], static_cast<double>(i));
      EXPECT_EQ(points.x[i], old_points.x[i]);
      continue;
    }
    const auto parent = static_cast<std::size_t>(ids[i]);
    EXPECT_NE(parent, 7u);
    farthest = std::max(farthest, std::hypot(points.x[i] - old_points.x[parent], points.y[i] - old_points.y[parent],
                                             points.z[i] - old_points.z[parent]));
    for (const char* name : {"normal_x", "normal_y", "normal_z"})
      EXPECT_TRUE(std::isfinite(after.value(i, after.findField(name))));
  }
  EXPECT_LT(farthest, 0.2) << "a parent is a neighbour: spacing is 0.055";
  // Without the hole and the offset, the points still lie on the cube.
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < after.size(); ++i)
    if (i != 7)
      finite.push_back(i);
  after = after.select(finite);
  for (std::size_t i = 0; i < after.size(); ++i) {
    after.setCoordinate(i, 0, points.x[finite[i]] - 500000);
    after.setCoordinate(i, 1, points.y[finite[i]] - 5400000);
    after.setCoordinate(i, 2, points.z[finite[i]] - 300);
  }
  EXPECT_LT(distanceToCube(after), 0.004);

  const nlohmann::json report = nlohmann::json::parse(readBytes(folder / "r.json"));
  EXPECT_EQ(report["schema"], "pcl_gpf.upsample/1");
  EXPECT_EQ(report["points"], after.size() + 1);
  EXPECT_EQ(report["new_points"], 3998);
  EXPECT_EQ(report["input"]["normals"], "estimated");
  EXPECT_LT(report["spacing"]["after"], report["spacing"]["before"]);
  EXPECT_EQ(report["target_reached"], true);
}

TEST(UpsampleCommand, targets)
{
  const TemporaryFolder folder;
  save(toCloudFile(cube(2000, 0.0, 3)), folder / "in.ply");
  const auto size = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"upsample", folder / "in.ply", "-o", folder / "out.ply", "--overwrite", "-q"});
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return readCloud(folder / "out.ply").size();
  };
  EXPECT_EQ(size({}), 4000u);
  EXPECT_EQ(size({"--count", "2345"}), 2345u);
  EXPECT_EQ(size({"--factor", "1.5", "--edge-sensitivity", "0"}), 3000u);
  EXPECT_NEAR(static_cast<double>(size({"--spacing", "0.5x", "--edge-sensitivity", "0"})), 8000, 1600);
  EXPECT_NEAR(static_cast<double>(size({"--method", "mls", "--factor", "3"})), 6000, 900);
}

TEST(UpsampleCommand, sameBytesForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  save(toCloudFile(cube(3000, 0.002, 3)), folder / "in.ply");
  for (const char* method : {"ear", "mls"}) {
    const auto bytes = [&](const char* threads) {
      runTool({"upsample", folder / "in.ply", "-o", folder / "out.ply", "--overwrite", "-q", "--method", method, "--threads", threads});
      return readBytes(folder / "out.ply");
    };
    const std::string one = bytes("1");
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(bytes("4"), one);
  }
}

TEST(UpsampleCommand, normalsOfTheFileAreUsedAndStay)
{
  const TemporaryFolder folder;
  const Shape shape = cube(1500, 0.0, 3);
  CloudFile cloud = toCloudFile(shape);
  for (int axis = 0; axis < 3; ++axis) {
    const int field = cloud.addField(std::string("normal_") + "xyz"[axis], FieldType::Float32);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.setValue(i, field, shape.normals[i][static_cast<std::size_t>(axis)]);
  }
  save(cloud, folder / "in.pcd");
  const ToolRun run = runTool({"upsample", folder / "in.pcd", "-o", folder / "out.pcd", "--oriented"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err.find("estimated"), std::string::npos);
  const CloudFile after = readCloud(folder / "out.pcd");
  const CloudCoordinates p = after.coordinates();
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double n[3] = {after.value(i, after.findField("normal_x")), after.value(i, after.findField("normal_y")),
                         after.value(i, after.findField("normal_z"))};
    EXPECT_GT(n[0] * (p.x[i] - 0.5) + n[1] * (p.y[i] - 0.5) + n[2] * (p.z[i] - 0.5), 0.0) << "outward, as in the input";
  }
}

TEST(UpsampleCommand, errorsBeforeTheWorkLeaveNoFile)
{
  const TemporaryFolder folder;
  save(toCloudFile(cube(500, 0.0, 3)), folder / "in.pcd");
  save(toCloudFile(Shape{}), folder / "empty.pcd");
  save(toCloudFile(plane(2)), folder / "two.pcd");
  Shape line;
  for (int i = 0; i < 40; ++i)
    line.points.push_back({0.1 * i, 0.2 * i, -0.3 * i});
  save(toCloudFile(line), folder / "line.pcd");
  const auto fails = [&](int code, const std::string& part, std::vector<std::string> words) {
    words.insert(words.begin(), "upsample");
    words.insert(words.end(), {"-o", folder / "x.pcd"});
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  };
  fails(2, "499", {folder / "in.pcd", "--count", "499"});
  fails(2, "500", {folder / "in.pcd", "--count", "499"});
  fails(2, "500", {folder / "in.pcd", "--count", "500001"});
  fails(2, "exclude", {folder / "in.pcd", "--count", "600", "--factor", "2"});
  fails(2, "factor", {folder / "in.pcd", "--factor", "0.5"});
  fails(2, "auto", {folder / "in.pcd", "--spacing", "auto"});
  fails(5, "3 neighbours", {folder / "in.pcd", "--method", "mls", "--radius", "1e-9"});
  fails(2, "edge-sensitivity", {folder / "in.pcd", "--edge-sensitivity", "11"});
  fails(2, "mls-order", {folder / "in.pcd", "--mls-order", "3"});
  fails(5, "pcl_gpf_tool normals", {folder / "in.pcd", "--oriented"});
  fails(5, "500", {folder / "in.pcd", "--spacing", "0.001x"});
  fails(5, "no points", {folder / "empty.pcd"});
  fails(5, "2", {folder / "two.pcd"});
  fails(5, "line", {folder / "line.pcd"});
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"empty.pcd", "in.pcd", "line.pcd", "two.pcd"}));
}

} // namespace
} // namespace pcl_gpf::test
