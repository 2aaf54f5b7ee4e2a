// SPDX-License-Identifier: BSD-3-Clause
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

constexpr std::size_t kCount = 20000;

/** A clean cube with ids, in double unless told otherwise. */
CloudFile
labelledCube(FieldType type = FieldType::Float64)
{
  CloudFile cloud = toCloudFile(cube(kCount, 0.0, 3), type);
  const int id = cloud.addField("id", FieldType::UInt32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, id, static_cast<double>(i));
  return cloud;
}

double
deviation(const std::vector<double>& before, const std::vector<double>& after)
{
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    sum += (after[i] - before[i]) * (after[i] - before[i]);
  return std::sqrt(sum / static_cast<double>(before.size()));
}

TEST(NoiseCommand, addsPercentOfTheDiagonalAndKeepsFieldsAndOrder)
{
  const TemporaryFolder folder;
  const CloudFile before = labelledCube();
  save(before, folder / "in.pcd");
  ASSERT_EQ(runTool({"noise", folder / "in.pcd", "-o", folder / "out.pcd", "--gaussian", "1%"}).exit_code, 0);
  const CloudFile after = readCloud(folder / "out.pcd");
  ASSERT_EQ(after.size(), kCount);
  EXPECT_EQ(after.column(after.findField("id")), before.column(before.findField("id")));
  const double wanted = 0.01 * std::sqrt(3.0);
  EXPECT_NEAR(deviation(before.coordinates().x, after.coordinates().x), wanted, 0.02 * wanted);
  EXPECT_NEAR(deviation(before.coordinates().y, after.coordinates().y), wanted, 0.02 * wanted);
  EXPECT_NEAR(deviation(before.coordinates().z, after.coordinates().z), wanted, 0.02 * wanted);
}

TEST(NoiseCommand, takesAbsoluteLengthsAndSpacings)
{
  const TemporaryFolder folder;
  const CloudFile before = labelledCube();
  save(before, folder / "in.pcd");
  ASSERT_EQ(runTool({"noise", folder / "in.pcd", "-o", folder / "a.pcd", "--uniform", "0.03"}).exit_code, 0);
  const double uniform = deviation(before.coordinates().x, readCloud(folder / "a.pcd").coordinates().x);
  EXPECT_NEAR(uniform, 0.03 / std::sqrt(3.0), 0.02 * 0.03);
  ASSERT_EQ(runTool({"noise", folder / "in.pcd", "-o", folder / "b.pcd", "--gaussian", "2x"}).exit_code, 0);
  const double spacing = std::sqrt(6.0 / kCount);
  const double gaussian = deviation(before.coordinates().x, readCloud(folder / "b.pcd").coordinates().x);
  EXPECT_NEAR(gaussian, 2 * spacing, 0.3 * spacing); // within the accuracy of the estimated spacing
}

TEST(NoiseCommand, sameSeedSameBytes)
{
  const TemporaryFolder folder;
  save(labelledCube(FieldType::Float32), folder / "in.ply");
  const auto bytes = [&](const std::string& seed, const std::string& threads) {
    runTool({"noise", folder / "in.ply", "-o", folder / "out.ply", "--overwrite", "--gaussian", "0.5x", "--uniform", "1%",
             "--outliers", "2%", "--seed", seed, "--threads", threads});
    return readBytes(folder / "out.ply");
  };
  const std::string first = bytes("7", "1");
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(bytes("7", "3"), first);
  EXPECT_NE(bytes("8", "1"), first);
}

TEST(NoiseCommand, outliersReplaceExactlyTheShareAndLeaveTheOtherBits)
{
  const TemporaryFolder folder;
  const CloudFile before = labelledCube();
  save(before, folder / "in.pcd");
  const std::vector<double> x = before.coordinates().x;
  for (const char* share : {"5%", "1000"}) {
    ASSERT_EQ(runTool({"noise", folder / "in.pcd", "-o", folder / "out.pcd", "--overwrite", "--outliers", share}).exit_code, 0);
    const CloudCoordinates after = readCloud(folder / "out.pcd").coordinates();
    std::size_t changed = 0;
    for (std::size_t i = 0; i < kCount; ++i)
      changed += after.x[i] != x[i];
    EXPECT_EQ(changed, 1000u);
  }
}

TEST(NoiseCommand, keepsHolesOfAnOrganisedCloud)
{
  const TemporaryFolder folder;
  CloudFile cloud = labelledCube(FieldType::Float32);
  cloud.width = 100;
  cloud.height = static_cast<std::uint32_t>(kCount / 100);
  for (const std::size_t hole : {0u, 77u, 19999u})
    cloud.setCoordinate(hole, 2, std::numeric_limits<double>::quiet_NaN());
  save(cloud, folder / "in.pcd");
  ASSERT_EQ(runTool({"noise", folder / "in.pcd", "-o", folder / "out.pcd", "--gaussian", "1%"}).exit_code, 0);
  const CloudFile after = readCloud(folder / "out.pcd");
  EXPECT_EQ(after.height, cloud.height);
  EXPECT_EQ(after.finiteCount(), kCount - 3);
  EXPECT_EQ(after.coordinates().x[77], cloud.coordinates().x[77]);
}

TEST(NoiseCommand, alongTheNormalNeedsNormals)
{
  const TemporaryFolder folder;
  CloudFile cloud = labelledCube();
  save(cloud, folder / "bare.pcd");
  const ToolRun refused = runTool({"noise", folder / "bare.pcd", "-o", folder / "out.pcd", "--along-normal", "1%"});
  EXPECT_EQ(refused.exit_code, 5);
  EXPECT_NE(refused.err.find("normals"), std::string::npos);
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    cloud.addField(name, FieldType::Float32);
  cloud.setColumn(cloud.findField("normal_x"), std::vector<double>(kCount, 1.0));
  save(cloud, folder / "normals.pcd");
  ASSERT_EQ(runTool({"noise", folder / "normals.pcd", "-o", folder / "out.pcd", "--along-normal", "1%"}).exit_code, 0);
  const CloudCoordinates after = readCloud(folder / "out.pcd").coordinates();
  EXPECT_EQ(after.y, cloud.coordinates().y);
  EXPECT_NEAR(deviation(cloud.coordinates().x, after.x), 0.01 * std::sqrt(3.0), 0.02 * 0.01 * std::sqrt(3.0));
}

TEST(NoiseCommand, exitCodes)
{
  const TemporaryFolder folder;
  save(labelledCube(), folder / "in.pcd");
  save(toCloudFile(Shape{}), folder / "empty.pcd");
  const auto code = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "noise");
    return runTool(words).exit_code;
  };
  EXPECT_EQ(code({folder / "in.pcd", "-o", folder / "x.pcd"}), 2);
  EXPECT_EQ(code({folder / "in.pcd", "-o", folder / "x.pcd", "--gaussian", "auto"}), 2);
  EXPECT_EQ(code({folder / "in.pcd", "-o", folder / "x.pcd", "--gaussian", "-1%"}), 2);
  EXPECT_EQ(code({folder / "in.pcd", "-o", folder / "x.pcd", "--outliers", "20001"}), 2);
  EXPECT_EQ(code({folder / "in.pcd", "--gaussian", "1%"}), 2);
  EXPECT_EQ(code({folder / "no.pcd", "-o", folder / "x.pcd", "--gaussian", "1%"}), 3);
  EXPECT_EQ(code({folder / "in.pcd", "-o", folder / "in.pcd", "--gaussian", "1%"}), 4);
  EXPECT_EQ(code({folder / "empty.pcd", "-o", folder / "x.pcd", "--gaussian", "1%"}), 5);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"empty.pcd", "in.pcd"}));
}

} // namespace
} // namespace pcl_gpf::test
