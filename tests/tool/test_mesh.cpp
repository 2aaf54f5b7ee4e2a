// SPDX-License-Identifier: BSD-3-Clause
// The command mesh: what is in its file and its report, and what it refuses before the work.
#include "run_tool.h"
#include "tool_clouds.h"

#include <pcl_gpf/io/mesh_file.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <signal.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

/** \brief A sphere with a red upper and a blue lower half. */
CloudFile
colouredSphere(bool normals, const Vector3& offset = {0, 0, 0})
{
  const Shape shape = sphere(4000);
  CloudFile cloud = toCloudFile(shape, FieldType::Float64, offset);
  const int red = cloud.addField("red", FieldType::UInt8), green = cloud.addField("green", FieldType::UInt8),
            blue = cloud.addField("blue", FieldType::UInt8);
  const char* names[3] = {"normal_x", "normal_y", "normal_z"};
  for (std::size_t i = 0; i < shape.size(); ++i) {
    cloud.setValue(i, shape.points[i][2] > 0 ? red : blue, 200);
    cloud.setValue(i, green, 10);
  }
  for (std::size_t axis = 0; normals && axis < 3; ++axis) {
    const int field = cloud.addField(names[axis], FieldType::Float32);
    for (std::size_t i = 0; i < shape.size(); ++i)
      cloud.setValue(i, field, shape.normals[i][axis]);
  }
  return cloud;
}

TEST(ToolMesh, MakesAClosedColouredMeshWithNormalsAndAReport)
{
  const TemporaryFolder folder;
  const Vector3 offset = {691000, 5335000, 500};
  save(colouredSphere(true, offset), folder / "in.ply");
  const ToolRun run =
      runTool({"mesh", folder / "in.ply", "-o", folder / "out.ply", "--resolution", "40", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("closed"), std::string::npos) << run.err;
  const TriangleMesh mesh = readMesh(folder / "out.ply");
  const CloudFile vertices = readCloud(folder / "out.ply");
  ASSERT_TRUE(vertices.hasNormals());
  const int red = vertices.findField("red"), blue = vertices.findField("blue"), nz = vertices.findField("normal_z");
  ASSERT_GE(red, 0);
  std::size_t right = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double z = mesh.vertices[3 * v + 2] - offset[2];
    const double radius = std::hypot(mesh.vertices[3 * v] - offset[0], mesh.vertices[3 * v + 1] - offset[1], z);
    ASSERT_NEAR(radius, 0.5, 0.01);
    ASSERT_NEAR(vertices.value(v, nz), 2 * z, 0.1);
    right += vertices.value(v, z > 0 ? red : blue) == 200;
  }
  EXPECT_GT(right, vertices.size() * 9 / 10);
  const json report = json::parse(readBytes(folder / "r.json"));
  EXPECT_EQ(report["schema"], "pcl_gpf.mesh/1");
  EXPECT_EQ(report["output"]["triangles"], mesh.triangleCount());
  EXPECT_EQ(report["output"]["open_edges"], 0);
  EXPECT_EQ(report["output"]["colors"], true);
  EXPECT_EQ(report["input"]["normals"], "file");
  EXPECT_EQ(report["orientation"]["oriented"], false);
}

TEST(ToolMesh, WithoutNormalsTheyAreEstimatedOrientedAndSaid)
{
  const TemporaryFolder folder;
  save(colouredSphere(false), folder / "in.ply");
  for (const char* method : {"rimls", "poisson"}) {
    const ToolRun run = runTool({"mesh", folder / "in.ply", "-o", folder / "out.ply", "--resolution", "40", "--method", method,
                                 "--overwrite"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("oriented"), std::string::npos) << run.err;
    const CloudFile vertices = readCloud(folder / "out.ply");
    const int nz = vertices.findField("normal_z"), z = vertices.findField("z");
    for (std::size_t v = 0; v < vertices.size(); ++v)
      ASSERT_NEAR(vertices.value(v, nz), 2 * vertices.value(v, z), 0.25) << method;
  }
}

TEST(ToolMesh, NormalsThatAreAllZeroAreEstimatedLikeMissingOnes)
{
  const TemporaryFolder folder;
  CloudFile cloud = colouredSphere(false);
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    cloud.addField(name, FieldType::Float32);
  save(cloud, folder / "zeros.ply");
  const ToolRun run = runTool({"mesh", folder / "zeros.ply", "-o", folder / "out.ply", "--resolution", "40"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("no normals"), std::string::npos) << run.err;
  EXPECT_EQ(runTool({"mesh", folder / "zeros.ply", "-o", folder / "no.ply", "--orientation", "file"}).exit_code, 5);
}

TEST(ToolMesh, RefusesBeforeTheWork)
{
  const TemporaryFolder folder;
  save(colouredSphere(true), folder / "in.ply");
  const std::string in = folder / "in.ply", out = folder / "out.ply";
  const auto refused = [&](std::vector<std::string> words, int code, const char* text) {
    words.insert(words.begin(), "mesh");
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"in.ply"});
  };
  refused({in, "-o", folder / "out.obj"}, 4, ".ply");
  refused({in}, 2, "output");
  refused({in, "-o", in}, 4, "overwrite");
  refused({in, "-o", out, "--resolution", "1"}, 2, "resolution");
  refused({in, "-o", out, "--resolution", "60000"}, 5, "GiB");
  refused({in, "-o", out, "--resolution", "400", "--memory", "1"}, 5, "GiB");
  refused({in, "-o", out, "--method", "poisson", "--scale", "3"}, 2, "poisson");
  refused({in, "-o", out, "--trim", "3"}, 2, "rimls");
  refused({in, "-o", out, "--method", "marching"}, 2, "poisson");
  refused({in, "-o", "-", "--json"}, 2, "standard output");
  refused({folder / "none.ply", "-o", out}, 3, "none.ply");
}

TEST(ToolMesh, ASignalLeavesNoPartialFile)
{
  const TemporaryFolder folder;
  save(colouredSphere(true), folder / "in.ply");
  RunSetup setup;
  setup.running = [](int process) { ::kill(process, SIGINT); };
  const ToolRun run = runTool({"mesh", folder / "in.ply", "-o", folder / "out.ply", "--resolution", "600"}, setup);
  EXPECT_NE(run.exit_code, 0);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"in.ply"});
}

TEST(ToolMesh, WritesToStandardOutput)
{
  const TemporaryFolder folder;
  save(colouredSphere(true), folder / "in.ply");
  const ToolRun run = runTool({"mesh", folder / "in.ply", "-o", "-", "--resolution", "20"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.compare(0, 4, "ply\n"), 0);
}

TEST(ToolMesh, APointFarAwayDoesNotHideTheSurfaceOfTheOthers)
{
  for (const double away : {1e9, 1e14}) {
    const TemporaryFolder folder;
    Shape shape = sphere(2000);
    shape.points.push_back({away, 0, 0});
    shape.normals.push_back({1, 0, 0});
    save(toCloudFile(shape), folder / "in.ply");
    const ToolRun run = runTool({"mesh", folder / "in.ply", "-o", folder / "out.ply", "--resolution", "20"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("closed"), std::string::npos) << run.err;
  }
}

} // namespace
} // namespace pcl_gpf::test
