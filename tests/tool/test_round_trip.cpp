// SPDX-License-Identifier: BSD-3-Clause
// The user's file comes back: the same points in the same order with all they carry; and the same bytes for any number of threads.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>

namespace pcl_gpf::test {
namespace {

/** Twelve fields of mixed types beside x, y, z, one of them before and one of count 3, filled with random bytes. */
CloudFile
mixedCloud()
{
  const Shape shape = cube(64 * 48, 0.01, 21);
  CloudFile cloud;
  cloud.width = 64;
  cloud.height = 48;
  cloud.viewpoint = {1.5, -2.5, 3.5, 0.5, 0.5, 0.5, 0.5};
  const int first = cloud.addField("id", FieldType::UInt32);
  for (const char* axis : {"x", "y", "z"})
    cloud.addField(axis, FieldType::Float32);
  const FieldType types[] = {FieldType::Int8, FieldType::UInt8, FieldType::Int16, FieldType::UInt16, FieldType::Int32,
                             FieldType::UInt32, FieldType::Float32, FieldType::Float64, FieldType::UInt8, FieldType::Int16};
  std::vector<int> fields{first};
  for (const FieldType type : types)
    fields.push_back(cloud.addField("field" + std::to_string(fields.size()), type));
  fields.push_back(cloud.addField("triple", FieldType::Float32, 3));
  SplitMix64 random(5);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      cloud.setCoordinate(i, axis, i % 7 == 3 ? std::nan("") : shape.points[i][static_cast<std::size_t>(axis)]);
    for (const int field : fields)
      for (std::size_t e = 0; e < cloud.fields[static_cast<std::size_t>(field)].count; ++e)
        cloud.setValue(i, field, static_cast<double>(random.below(100)), e);
  }
  return cloud;
}

void
expectForeignFieldsUnchanged(const CloudFile& before, const CloudFile& after)
{
  for (std::size_t f = 0; f < before.fields.size(); ++f) {
    const CloudField& field = before.fields[f];
    if (field.name == "x" || field.name == "y" || field.name == "z")
      continue;
    const int found = after.findField(field.name);
    ASSERT_GE(found, 0) << field.name;
    const CloudField& other = after.fields[static_cast<std::size_t>(found)];
    EXPECT_EQ(other.type, field.type) << field.name;
    ASSERT_EQ(other.count, field.count) << field.name;
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_EQ(std::memcmp(&before.data[i * before.pointStep() + field.offset], &after.data[i * after.pointStep() + other.offset],
                            sizeOf(field.type) * field.count),
                0)
          << field.name << " of point " << i;
  }
}

TEST(ToolRoundTrip, MixedFieldsOrganisationHolesAndViewpointStay)
{
  TemporaryFolder folder;
  const CloudFile before = mixedCloud();
  save(before, folder / "in.pcd");
  for (const char* name : {"out.pcd", "out.ply"}) {
    const ToolRun run = runTool({"filter", folder / "in.pcd", "-o", folder / name});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const CloudFile after = readCloud(folder / name);
    EXPECT_EQ(after.size(), before.size());
    EXPECT_EQ(after.width, before.width);
    EXPECT_EQ(after.height, before.height);
    EXPECT_EQ(after.viewpoint, before.viewpoint);
    expectForeignFieldsUnchanged(before, after);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double x = after.value(i, after.findField("x"));
      EXPECT_EQ(std::isnan(x), i % 7 == 3) << i;
      EXPECT_EQ(std::isnan(after.value(i, after.findField("normal_x"))), i % 7 == 3) << i;
      moved += x != before.value(i, before.findField("x")) ? 1 : 0;
    }
    EXPECT_GT(moved, before.size() / 4);
  }
}

TEST(ToolRoundTrip, MillimetresFarFromTheOriginSurviveInDouble)
{
  TemporaryFolder folder;
  const Vector3 offset{691000, 5335000, 500};
  // Multiples of 2^-20, so that the shifted coordinates are exact and both clouds are the same but for the offset.
  Shape shape = cube(4000, 0.004, 31);
  for (Vector3& point : shape.points)
    for (double& value : point)
      value = std::round(value * 0x1p20) * 0x1p-20;
  save(toCloudFile(shape, FieldType::Float64), folder / "local.ply");
  save(toCloudFile(shape, FieldType::Float64, offset), folder / "utm.ply");
  for (const char* name : {"local", "utm"}) {
    const ToolRun run = runTool({"filter", folder / (std::string(name) + ".ply"), "-o", folder / (std::string(name) + "_out.ply"), "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const CloudFile local = readCloud(folder / "local_out.ply");
  const CloudFile utm = readCloud(folder / "utm_out.ply");
  EXPECT_EQ(utm.fields[0].type, FieldType::Float64);
  for (std::size_t i = 0; i < local.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(utm.value(i, axis) - offset[static_cast<std::size_t>(axis)], local.value(i, axis), 1e-6) << i;
}

TEST(ToolRoundTrip, FloatsTooFarFromTheOriginAreRefused)
{
  TemporaryFolder folder;
  const Shape shape = cube(4000, 0.004, 31);
  save(toCloudFile(shape, FieldType::Float32, {691000, 5335000, 500}), folder / "utm.ply");
  const ToolRun refused = runTool({"filter", folder / "utm.ply", "-o", folder / "out.ply"});
  EXPECT_EQ(refused.exit_code, 5);
  EXPECT_NE(refused.err.find("0.5"), std::string::npos) << refused.err;
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"utm.ply"}));
  EXPECT_EQ(runTool({"filter", folder / "utm.ply", "-o", folder / "out.ply", "--force"}).exit_code, 0);

  // At 2000 units the step is 1/8192 = 0.00012, the spacing 0.039: worth a warning, and no more than that.
  save(toCloudFile(shape, FieldType::Float32, {8000, 0, 0}), folder / "near.ply");
  const ToolRun warned = runTool({"filter", folder / "near.ply", "-o", folder / "near_out.ply", "--json", "-q"});
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_NE(warned.err.find("warning: coordinates are quantised"), std::string::npos) << warned.err;
  EXPECT_EQ(nlohmann::json::parse(warned.out)["warnings"].size(), 1u);
}

TEST(ToolRoundTrip, OnePointFarAwayNeitherMakesTheOthersCoarseNorChangesTheirSpacing)
{
  const TemporaryFolder folder;
  Shape shape = cube(4000, 0.004, 31);
  save(toCloudFile(shape), folder / "near.ply");
  shape.points[7] = {2e7, 0, 0}; // where floats are 2 apart
  save(toCloudFile(shape), folder / "stray.ply");
  const auto spacing = [&](const char* name) {
    return nlohmann::json::parse(runTool({"info", folder / name, "--json"}).out)["spacing"].get<double>();
  };
  EXPECT_NEAR(spacing("stray.ply"), spacing("near.ply"), 0.02 * spacing("near.ply"));
  const ToolRun run = runTool({"filter", folder / "stray.ply", "-o", folder / "out.ply", "--radius", "8x", "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err.find("quantised"), std::string::npos) << run.err;
}

TEST(ToolRoundTrip, CoordinatesAtTheLimitOfFloatStayFinite)
{
  const TemporaryFolder folder;
  Shape shape = cube(1500, 0.0, 5);
  for (Vector3& p : shape.points)
    for (double& c : p)
      c = (2.0 * c - 1.0) * static_cast<double>(std::numeric_limits<float>::max()) / 1.0001;
  save(toCloudFile(shape), folder / "in.pcd");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"filter", "--preset", "paper", "--iterations", "3"},
                                                std::vector<std::string>{"upsample"}, std::vector<std::string>{"mesh", "--resolution", "20"},
                                                std::vector<std::string>{"run", "--stages", "filter,upsample", "--filter-repulsion", "0.5"}}) {
    std::vector<std::string> all = words;
    all.insert(all.begin() + 1, folder / "in.pcd");
    all.insert(all.end(), {"-o", folder / "out.ply", "--overwrite", "-q"});
    const ToolRun run = runTool(all);
    ASSERT_EQ(run.exit_code, 0) << words.front() << ": " << run.err;
    const nlohmann::json info = nlohmann::json::parse(runTool({"info", folder / "out.ply", "--json"}).out);
    EXPECT_EQ(info["finite"], info["points"]) << words.front();
  }
}

TEST(ToolRoundTrip, TheNumberOfThreadsChangesNoByte)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 15000);
  for (const std::vector<std::string>& extra : {std::vector<std::string>{}, std::vector<std::string>{"--samples", "50%", "--repulsion", "0.2"},
                                                std::vector<std::string>{"--preset", "paper", "--iterations", "5"}}) {
    std::string first;
    for (const char* threads : {"1", "2", "7"}) {
      std::vector<std::string> words{"filter", input, "-o", folder / "out.pcd", "--overwrite", "-q", "--threads", threads};
      words.insert(words.end(), extra.begin(), extra.end());
      const ToolRun run = runTool(words);
      ASSERT_EQ(run.exit_code, 0) << run.err;
      const std::string bytes = readBytes(folder / "out.pcd");
      if (first.empty())
        first = bytes;
      EXPECT_TRUE(bytes == first) << threads;
    }
  }
}

TEST(ToolDegenerate, DataThatCannotBeFilteredAreExitCode5)
{
  TemporaryFolder folder;
  const auto filter = [&](const CloudFile& cloud) {
    save(cloud, folder / "in.pcd");
    const ToolRun run = runTool({"filter", folder / "in.pcd", "-o", folder / "out.pcd"});
    EXPECT_EQ(folder.entries().size(), run.exit_code == 0 ? 2u : 1u);
    return run.exit_code;
  };
  EXPECT_EQ(filter(toCloudFile(Shape())), 5);
  EXPECT_EQ(filter(toCloudFile(cube(1))), 5);
  Shape same;
  same.points.assign(100, Vector3{1, 2, 3});
  EXPECT_EQ(filter(toCloudFile(same)), 5);
  same.points.assign(100, Vector3{std::nan(""), 2, 3});
  EXPECT_EQ(filter(toCloudFile(same)), 5);
}

TEST(ToolDegenerate, LinesAndAFewPointsAreFilteredOrRefusedButNeverCrash)
{
  TemporaryFolder folder;
  Shape line;
  for (int i = 0; i < 200; ++i)
    line.points.push_back({0.01 * i, 0.02 * i, -0.01 * i});
  for (const CloudFile& cloud : {toCloudFile(line), toCloudFile(cube(2)), toCloudFile(cube(3)), toCloudFile(cube(5))}) {
    save(cloud, folder / "in.pcd");
    const ToolRun run = runTool({"filter", folder / "in.pcd", "-o", folder / "out.pcd", "--overwrite"});
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 5) << run.exit_code << run.err;
    if (run.exit_code == 0) {
      const CloudFile result = readCloud(folder / "out.pcd");
      EXPECT_EQ(result.finiteCount(), cloud.size());
    }
  }
}

} // namespace
} // namespace pcl_gpf::test
