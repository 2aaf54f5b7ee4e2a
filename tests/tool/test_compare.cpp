// SPDX-License-Identifier: BSD-3-Clause
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl_gpf::test {
namespace {

using Json = nlohmann::json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const char* const kCubeOff = "OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
                             "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
const char* const kSquarePly = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

CloudFile
cloudOf(const std::vector<Vector3>& points)
{
  Shape shape;
  shape.points = points;
  return toCloudFile(shape, FieldType::Float64);
}

Json
compareJson(std::vector<std::string> words)
{
  words.insert(words.begin(), "compare");
  words.push_back("--json");
  const ToolRun run = runTool(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return Json::parse(run.out);
}

TEST(CompareCommand, cloudToCloudEqualsBruteForce)
{
  const TemporaryFolder folder;
  const CloudFile a = toCloudFile(cube(700, 0.02, 1)), b = toCloudFile(cube(900, 0.0, 2));
  save(a, folder / "a.pcd");
  save(b, folder / "b.ply");
  const Json report = compareJson({folder / "a.pcd", folder / "b.ply", "--symmetric"});

  const auto nearest = [](const CloudFile& from, const CloudFile& to) {
    const CloudCoordinates p = from.coordinates(), q = to.coordinates();
    std::vector<double> distances(from.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < from.size(); ++i)
      for (std::size_t j = 0; j < to.size(); ++j)
        distances[i] = std::min(distances[i], std::hypot(p.x[i] - q.x[j], p.y[i] - q.y[j], p.z[i] - q.z[j]));
    std::sort(distances.begin(), distances.end());
    return distances;
  };
  const auto expectEqual = [](const Json& json, const std::vector<double>& distances) {
    double sum = 0, squares = 0;
    for (const double distance : distances) {
      sum += distance;
      squares += distance * distance;
    }
    const auto count = static_cast<double>(distances.size());
    EXPECT_EQ(json["points"], distances.size());
    EXPECT_NEAR(json["mean"], sum / count, 1e-12);
    EXPECT_NEAR(json["rms"], std::sqrt(squares / count), 1e-12);
    EXPECT_EQ(json["max"], distances.back());
    const double rank = 0.95 * (count - 1);
    const auto below = static_cast<std::size_t>(rank);
    const double p95 = distances[below] + (rank - std::floor(rank)) * (distances[below + 1] - distances[below]);
    EXPECT_NEAR(json["p95"], p95, 1e-12);
  };
  expectEqual(report, nearest(a, b));
  expectEqual(report["back"], nearest(b, a));
  const double diagonal = report["b"]["diagonal"];
  EXPECT_NEAR(report["rms_percent"], 100 * report["rms"].get<double>() / diagonal, 1e-12);
  EXPECT_EQ(report["hausdorff"], std::max(report["max"].get<double>(), report["back"]["max"].get<double>()));
}

TEST(CompareCommand, ofACloudWithItselfIsZero)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd");
  const Json report = compareJson({path, path, "--symmetric"});
  EXPECT_EQ(report["max"], 0.0);
  EXPECT_EQ(report["back"]["max"], 0.0);
}

TEST(CompareCommand, distanceToTheSurfaceOfAMeshHasASign)
{
  const TemporaryFolder folder;
  writeBytes(folder / "cube.off", kCubeOff);
  // 0.25 inside, 0.5 outside a face, and 1 outside along each axis from a corner.
  save(cloudOf({{0.5, 0.5, 0.25}, {0.5, 0.5, 1.5}, {2, 2, 2}}), folder / "a.pcd");
  const Json report = compareJson({folder / "a.pcd", folder / "cube.off"});
  const double corner = std::sqrt(3.0);
  EXPECT_EQ(report["b"]["kind"], "surface");
  EXPECT_EQ(report["b"]["triangles"], 12);
  EXPECT_NEAR(report["b"]["diagonal"], std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(report["mean"], (0.25 + 0.5 + corner) / 3, 1e-12);
  EXPECT_NEAR(report["signed_mean"], (-0.25 + 0.5 + corner) / 3, 1e-12);
  EXPECT_NEAR(report["max_percent"], 100.0, 1e-9);
}

TEST(CompareCommand, facesOfAPlyCountUnlessPointsAreAskedFor)
{
  const TemporaryFolder folder;
  writeBytes(folder / "square.ply", kSquarePly);
  save(cloudOf({{0.5, 0.5, 0.1}}), folder / "a.pcd");
  EXPECT_NEAR(compareJson({folder / "a.pcd", folder / "square.ply"})["mean"], 0.1, 1e-12);
  const Json points = compareJson({folder / "a.pcd", folder / "square.ply", "--to", "points"});
  EXPECT_NEAR(points["mean"], std::sqrt(0.51), 1e-12);
  EXPECT_EQ(points["b"]["kind"], "points");
  EXPECT_FALSE(points.contains("signed_mean"));
}

TEST(CompareCommand, theWayBackFromAMeshShowsWhatIsMissing)
{
  const TemporaryFolder folder;
  writeBytes(folder / "square.ply", kSquarePly);
  std::vector<Vector3> left_half;
  for (int i = 0; i <= 50; ++i)
    for (int j = 0; j <= 100; ++j)
      left_half.push_back({i / 100.0, j / 100.0, 0});
  save(cloudOf(left_half), folder / "a.pcd");
  const Json report = compareJson({folder / "a.pcd", folder / "square.ply", "--symmetric"});
  EXPECT_NEAR(report["max"], 0.0, 1e-7); // to the surface: nothing wrong
  EXPECT_NEAR(report["back"]["max"], 0.5, 0.01);
  EXPECT_NEAR(report["back"]["mean"], 0.125, 0.01);
  EXPECT_EQ(report["back"]["points"], 200000);
}

TEST(CompareCommand, sameOrderMeasuresRowByRow)
{
  const TemporaryFolder folder;
  save(cloudOf({{0, 0, 0}, {1, 0, 0}, {0, kNaN, 0}, {5, 0, 0}}), folder / "a.pcd");
  save(cloudOf({{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {5, 0, 0}}), folder / "b.pcd");
  EXPECT_EQ(compareJson({folder / "a.pcd", folder / "b.pcd"})["max"], 0.0);
  const Json report = compareJson({folder / "a.pcd", folder / "b.pcd", "--same-order"});
  EXPECT_EQ(report["points"], 3);
  EXPECT_EQ(report["left_out"], 1);
  EXPECT_NEAR(report["mean"], 2.0 / 3, 1e-12);
}

TEST(CompareCommand, perPointWritesTheDistancesBesideAllFields)
{
  const TemporaryFolder folder;
  writeBytes(folder / "cube.off", kCubeOff);
  CloudFile a = cloudOf({{0.5, 0.5, 0.25}, {kNaN, 0, 0}, {0.5, 0.5, 1.5}});
  const int taken = a.addField("distance", FieldType::Float32);
  a.setValue(0, taken, 42);
  save(a, folder / "a.pcd");
  compareJson({folder / "a.pcd", folder / "cube.off", "--per-point", folder / "out.ply"});
  const CloudFile out = readCloud(folder / "out.ply");
  EXPECT_EQ(out.value(0, out.findField("distance")), 42); // the scanner's own field of that name
  const std::vector<double> distances = out.column(out.findField("distance_to_reference"));
  const std::vector<double> signed_distances = out.column(out.findField("signed_distance"));
  EXPECT_NEAR(distances[0], 0.25, 1e-12);
  EXPECT_NEAR(signed_distances[0], -0.25, 1e-12);
  EXPECT_TRUE(std::isnan(distances[1]));
  EXPECT_NEAR(distances[2], 0.5, 1e-12);
}

TEST(CompareCommand, textGoesToStandardOutput)
{
  const TemporaryFolder folder;
  const std::string path = saveNoisyCube(folder / "a.pcd");
  const ToolRun run = runTool({"compare", path, path});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* word : {"mean", "rms", "p95", "max", "%"})
    EXPECT_NE(run.out.find(word), std::string::npos);
  EXPECT_EQ(run.err, "");
}

TEST(CompareCommand, exitCodes)
{
  const TemporaryFolder folder;
  const std::string cloud = saveNoisyCube(folder / "a.pcd");
  save(toCloudFile(Shape{}), folder / "empty.pcd");
  save(cloudOf({{kNaN, 0, 0}}), folder / "nan.pcd");
  save(cloudOf({{0, 0, 0}}), folder / "one.pcd");
  writeBytes(folder / "broken.off", "OFF\n3 1 0\n0 0 0\n");
  const auto code = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "compare");
    return runTool(words).exit_code;
  };
  EXPECT_EQ(code({cloud}), 2);
  EXPECT_EQ(code({cloud, cloud, "--same-order", "--symmetric"}), 2);
  EXPECT_EQ(code({cloud, cloud, "--same-order", "--to", "surface"}), 2);
  EXPECT_EQ(code({cloud, cloud, "--per-point", "-"}), 2);
  EXPECT_EQ(code({cloud, folder / "none.pcd"}), 3);
  EXPECT_EQ(code({cloud, folder / "broken.off"}), 3);
  EXPECT_EQ(code({cloud, cloud, "--to", "surface"}), 3);
  EXPECT_EQ(code({cloud, cloud, "--per-point", cloud}), 4);
  EXPECT_EQ(code({folder / "empty.pcd", cloud}), 5);
  EXPECT_EQ(code({cloud, folder / "empty.pcd"}), 5);
  EXPECT_EQ(code({folder / "nan.pcd", cloud}), 5);
  EXPECT_EQ(code({cloud, folder / "nan.pcd"}), 5);
  EXPECT_EQ(code({cloud, folder / "one.pcd", "--same-order"}), 5);
  EXPECT_EQ(code({cloud, folder / "one.pcd"}), 0);
  EXPECT_TRUE(compareJson({cloud, folder / "one.pcd"})["mean_percent"].is_null()); // one place has no diagonal
}

} // namespace
} // namespace pcl_gpf::test
