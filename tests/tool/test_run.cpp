// SPDX-License-Identifier: BSD-3-Clause
// The command run: the chain in one go, its configuration file, and what it refuses before the work.
#include "run_tool.h"
#include "tool_clouds.h"

#include <pcl_gpf/io/mesh_file.h>
#include <pcl_gpf/pipeline/consolidate.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <signal.h>

#include <limits>
#include <sstream>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

/** \brief A noisy sphere in double with a label; the first row is not finite. */
std::string
saveSphere(const std::string& path)
{
  CloudFile cloud = toCloudFile(sphere(3000, 0.003), FieldType::Float64);
  const int label = cloud.addField("label", FieldType::UInt32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, label, static_cast<double>(i));
  cloud.setCoordinate(0, 1, std::numeric_limits<double>::quiet_NaN());
  save(cloud, path);
  return path;
}

TEST(ToolRun, IsTheCommandsOneAfterTheOther)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply");
  ASSERT_EQ(runTool({"filter", in, "-o", folder / "f.ply"}).exit_code, 0);
  ASSERT_EQ(runTool({"orient", folder / "f.ply", "-o", folder / "o.ply"}).exit_code, 0);
  ASSERT_EQ(runTool({"mesh", folder / "o.ply", "-o", folder / "m.ply", "--resolution", "40"}).exit_code, 0);
  const ToolRun run = runTool({"run", in, "-o", folder / "run.ply", "--mesh-resolution", "40", "--json=" + (folder / "r.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const TriangleMesh steps = readMesh(folder / "m.ply"), chain = readMesh(folder / "run.ply");
  EXPECT_EQ(chain.vertices, steps.vertices); // to the last bit, as the clouds on the way are in double
  EXPECT_EQ(chain.triangles, steps.triangles);
  const json report = json::parse(readBytes(folder / "r.json"));
  EXPECT_EQ(report["schema"], "pcl_gpf.run/1");
  EXPECT_EQ(report["stages"], (json{"filter", "orient", "mesh"}));
  EXPECT_EQ(report["input"]["finite"], 2999);
  EXPECT_EQ(report["mesh"]["open_edges"], 0);
  EXPECT_EQ(report["output"]["triangles"], chain.triangleCount());
  double sum = 0.0;
  for (const char* stage : {"read", "check", "normals", "filter", "orient", "upsample", "mesh", "write"}) {
    ASSERT_TRUE(report["seconds"][stage].is_number()) << stage;
    sum += report["seconds"][stage].get<double>();
  }
  EXPECT_GT(report["seconds"]["mesh"], 0.0);
  EXPECT_LE(sum, report["seconds"]["total"].get<double>() * 1.01);
}

TEST(ToolRun, IsConsolidateOnTheFilesNumbersAndTellsHowFarTheWholeIs)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply");
  const ToolRun run = runTool({"run", in, "-o", folder / "run.ply", "--stages", "filter,orient,upsample,mesh", "--mesh-resolution", "30",
                               "--progress", "plain", "--keep-intermediate", folder / "step"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CloudFile cloud = readCloud(in);
  std::vector<double> columns[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < cloud.size(); ++i)
      columns[axis].push_back(cloud.value(i, static_cast<int>(axis)));
  ConsolidationParameters p;
  p.upsample = true;
  p.meshing.rimls.resolution = 30;
  const ConsolidationResult expected = consolidate({columns[0].data(), columns[1].data(), columns[2].data(), cloud.size()}, p);
  const CloudFile dense = readCloud(folder / "step-upsampled.ply");
  ASSERT_EQ(dense.size(), expected.upsampled.size());
  for (std::size_t i = 0; i < dense.size(); ++i) {
    ASSERT_EQ(dense.value(i, 0), expected.upsampled.x[i]);
    ASSERT_EQ(dense.value(i, dense.findField("normal_y")), static_cast<double>(expected.upsampled.normal_y[i]));
    ASSERT_EQ(dense.value(i, dense.findField("label")), static_cast<double>(expected.upsampled.source_rows[i]));
  }
  EXPECT_EQ(readMesh(folder / "run.ply").triangles, expected.mesh.triangles);

  std::istringstream lines(run.err);
  std::string line;
  int last = 0;
  while (std::getline(lines, line) && line.find(" %") != std::string::npos) {
    const int percent = std::stoi(line.substr(line.find_first_of("0123456789")));
    EXPECT_GT(percent, last) << run.err;
    last = percent;
  }
  EXPECT_EQ(last, 100) << run.err;
}

TEST(ToolRun, KeepsIntermediateCloudsWithAllFields)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply");
  const ToolRun run = runTool({"run", in, "-o", folder / "out.ply", "--stages", "filter,orient,upsample,mesh", "--upsample-factor", "3",
                               "--mesh-resolution", "30", "--keep-intermediate", folder / "step"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"in.ply", "out.ply", "step-filtered.ply", "step-upsampled.ply"}));
  const CloudFile filtered = readCloud(folder / "step-filtered.ply"), dense = readCloud(folder / "step-upsampled.ply");
  ASSERT_EQ(filtered.size(), 2999u);
  EXPECT_EQ(dense.size(), 3u * 2999u);
  EXPECT_TRUE(dense.hasNormals());
  for (std::size_t i = 0; i < filtered.size(); ++i)
    ASSERT_EQ(filtered.value(i, filtered.findField("label")), static_cast<double>(i + 1));
  EXPECT_EQ(readMesh(folder / "out.ply").vertices.empty(), false);
}

TEST(ToolRun, WithoutTheStageMeshTheOutputIsACloud)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply");
  const ToolRun run = runTool({"run", in, "-o", folder / "out.pcd", "--stages", "normals,filter", "--format", "pcd-binary"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const CloudFile cloud = readCloud(folder / "out.pcd");
  EXPECT_EQ(cloud.size(), 2999u);
  EXPECT_TRUE(cloud.hasNormals());
}

TEST(ToolRun, TakesOptionsFromAFileAndTheCommandLineGoesFirst)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply"), config = folder / "run.json";
  writeBytes(config, R"({"stages": ["filter", "orient", "mesh"], "threads": 1, "overwrite": true,
                         "filter": {"preset": "freeform", "iterations": 3, "posterior-normalization": false},
                         "upsample": {"factor": 4}, "mesh": {"resolution": 20, "no-projection": true}})");
  const auto triangles = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", in, "-o", folder / "out.ply", "--overwrite", "--json=" + (folder / "r.json")});
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return readMesh(folder / "out.ply").triangleCount();
  };
  const std::size_t coarse = triangles({"--config", config});
  const json report = json::parse(readBytes(folder / "r.json"));
  EXPECT_EQ(report["threads"], 1);
  EXPECT_EQ(report["filter"]["parameters"]["iterations"]["value"], 3);
  EXPECT_EQ(report["filter"]["parameters"]["iterations"]["origin"], "user");
  EXPECT_EQ(report["filter"]["parameters"]["bilateral-angle"]["value"], 60);
  EXPECT_EQ(report["filter"]["parameters"]["bilateral-angle"]["origin"], "preset");
  EXPECT_EQ(coarse, triangles({"--filter-preset", "freeform", "--filter-iterations", "3", "--filter-posterior-normalization", "off",
                               "--mesh-resolution", "20", "--mesh-no-projection"}));
  EXPECT_GT(triangles({"--config", config, "--mesh-resolution", "60"}), 6 * coarse);
}

TEST(ToolRun, RefusesBeforeTheWork)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply"), out = folder / "out.ply", config = folder / "run.json";
  writeBytes(config, "{}");
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& text) {
    words.insert(words.begin(), {"run", in});
    const ToolRun run = runTool(words);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"in.ply", "run.json"}));
  };
  refused({}, 2, "output");
  refused({"-o", folder / "out.obj"}, 4, ".ply");
  refused({"-o", in}, 4, "overwrite");
  refused({"-o", out, "--stages", "filter,msh"}, 2, "did you mean 'mesh'");
  refused({"-o", out, "--stages", "mesh,mesh"}, 2, "twice");
  refused({"-o", out, "--stages", "mesh"}, 2, "normals");
  refused({"-o", out, "--upsample-factor", "3"}, 2, "without the stage upsample");
  refused({"-o", out, "--mesh-trim", "3"}, 2, "stage mesh");
  refused({"-o", out, "--format", "ply-ascii"}, 2, "--format");
  refused({"-o", out, "--mesh-resolution", "60000"}, 5, "GiB");
  refused({"-o", out, "--stages", "upsample,mesh", "--upsample-count", "100"}, 2, "100");
  refused({"-o", folder / "p-filtered.ply", "--keep-intermediate", folder / "p"}, 2, "intermediate");
  refused({"-o", out, "--keep-intermediate", folder / "none/p"}, 4, "none");
  refused({"-o", out, "--config", folder / "missing.json"}, 3, "missing.json");
  const auto badConfig = [&](const std::string& content, int code, const std::string& text) {
    writeBytes(config, content);
    refused({"-o", out, "--config", config}, code, text);
  };
  badConfig("", 3, "run.json");
  badConfig("{\"mesh\": ", 3, "byte");
  badConfig("[1, 2]", 3, "array");
  badConfig(R"({"mesh": {"resolutoin": 3}})", 2, "--mesh-resolution");
  badConfig(R"({"mesh": {"resolution": 1}})", 2, "65536");
  badConfig(R"({"mesh": {"resolution": null}})", 2, "mesh-resolution");
  badConfig(R"({"mesh": {"deep": {"resolution": 3}}})", 2, "mesh-deep");
  badConfig(R"({"mesh": {"resolution": 1e999}})", 3, "range of double");
  badConfig(R"({"config": "other.json"})", 2, "config");
  badConfig(R"({"stages": []})", 2, "stages");
}

TEST(ToolRun, ASignalLeavesNoPartialFile)
{
  const TemporaryFolder folder;
  const std::string in = saveSphere(folder / "in.ply");
  RunSetup setup;
  setup.running = [](int process) { ::kill(process, SIGINT); };
  const ToolRun run = runTool({"run", in, "-o", folder / "out.ply", "--mesh-resolution", "600", "--keep-intermediate", folder / "step"}, setup);
  EXPECT_NE(run.exit_code, 0);
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"in.ply"});
}

} // namespace
} // namespace pcl_gpf::test
