// SPDX-License-Identifier: BSD-3-Clause
// Extra fields, outliers, bounded moves and presets of the command filter.
#include "run_tool.h"
#include "tool_clouds.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

/** A noisy unit cube, then `outliers` points of the box about it. */
Shape
cubeWithOutliers(std::size_t count, std::size_t outliers)
{
  Shape shape = cube(count, 0.005, 7);
  SplitMix64 random(8);
  for (std::size_t i = 0; i < outliers; ++i) {
    shape.points.push_back({1.4 * random.uniform() - 0.2, 1.4 * random.uniform() - 0.2, 1.4 * random.uniform() - 0.2});
    shape.normals.push_back({0, 0, 1});
  }
  return shape;
}

json
filterReport(std::vector<std::string> words)
{
  words.insert(words.begin(), "filter");
  words.insert(words.end(), {"--overwrite", "--json", "-q"});
  const ToolRun run = runTool(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? json::parse(run.out) : json();
}

/** Lengths of the moves of all rows of `after`, each from row from[k] of `before`. */
template <typename From>
std::vector<double>
movements(const CloudFile& before, const CloudFile& after, const From& from)
{
  const CloudCoordinates a = before.coordinates(), b = after.coordinates();
  std::vector<double> lengths;
  for (std::size_t k = 0; k < b.x.size(); ++k)
    lengths.push_back(std::hypot(b.x[k] - a.x[from(k)], b.y[k] - a.y[from(k)], b.z[k] - a.z[from(k)]));
  return lengths;
}

std::vector<std::string>
namesOf(const CloudFile& cloud)
{
  std::vector<std::string> names;
  for (const CloudField& field : cloud.fields)
    names.push_back(field.name);
  return names;
}

TEST(ToolResultFields, AreFloatsInTheirOrderInEveryFormat)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 10000, 0.01);
  const CloudFile before = readCloud(input);
  for (const std::string name : {"out.pcd", "out.ply", "out.xyz"}) {
    const json report = filterReport({input, "-o", folder / name, "--fields", "sigma,movement,outlier,edge", "--no-normals"});
    const CloudFile after = readCloud(folder / name);
    EXPECT_EQ(namesOf(after), (std::vector<std::string>{"x", "y", "z", "sigma", "movement", "outlier", "edge"})) << name;
    EXPECT_EQ(report["fields"], (json{"sigma", "movement", "outlier", "edge"}));
    const std::vector<double> moves = movements(before, after, [](std::size_t k) { return k; });
    std::size_t edges = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      ASSERT_NEAR(after.value(i, 4), moves[i], 1e-7);
      edges += after.value(i, 6) == 1.0;
      ASSERT_TRUE(after.value(i, 6) == 1.0 || after.value(i, 6) == 0.0);
      ASSERT_TRUE(after.value(i, 5) >= 0.0 && after.value(i, 5) <= 1.0);
    }
    std::vector<double> sigma = after.column(3);
    std::nth_element(sigma.begin(), sigma.begin() + 5000, sigma.end());
    EXPECT_NEAR(sigma[5000], 0.01, 0.0015);
    EXPECT_EQ(report["edge_points"], edges);
    EXPECT_GT(edges, 1000u);
    EXPECT_LT(edges, 6000u);
  }
}

TEST(ToolResultFields, OfSamplesBelongToTheirRows)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(3000, 0.005, 11));
  const int label = cloud.addField("label", FieldType::UInt32);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, label, static_cast<double>(i));
  save(cloud, folder / "in.pcd");
  filterReport({folder / "in.pcd", "-o", folder / "out.pcd", "--samples", "30%", "--fields", "movement,edge,sigma"});
  const CloudFile after = readCloud(folder / "out.pcd");
  ASSERT_EQ(after.size(), 900u);
  const int field = after.findField("movement");
  const std::vector<double> moves =
      movements(cloud, after, [&](std::size_t k) { return static_cast<std::size_t>(after.value(k, label)); });
  for (std::size_t k = 0; k < after.size(); ++k)
    ASSERT_NEAR(after.value(k, field), moves[k], 1e-8);
  EXPECT_EQ(namesOf(after).back(), "outlier");
}

TEST(ToolResultFields, AreNaNWherePointsAreNot)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(3000, 0.005, 11));
  cloud.width = 60;
  cloud.height = 50;
  cloud.setCoordinate(17, 1, std::numeric_limits<double>::quiet_NaN());
  save(cloud, folder / "in.pcd");
  filterReport({folder / "in.pcd", "-o", folder / "out.pcd", "--fields", "movement,sigma,edge,outlier"});
  const CloudFile after = readCloud(folder / "out.pcd");
  EXPECT_TRUE(after.isOrganized());
  for (const char* name : {"movement", "sigma", "edge", "outlier"}) {
    EXPECT_TRUE(std::isnan(after.value(17, after.findField(name)))) << name;
    EXPECT_TRUE(std::isfinite(after.value(18, after.findField(name)))) << name;
  }
}

TEST(ToolResultFields, OfTheInputAreReplacedAndListsRefused)
{
  TemporaryFolder folder;
  CloudFile cloud = toCloudFile(cube(3000, 0.005, 11));
  const int edge = cloud.addField("edge", FieldType::UInt8);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.setValue(i, edge, 77);
  save(cloud, folder / "in.pcd");
  const ToolRun run = runTool({"filter", folder / "in.pcd", "-o", folder / "out.pcd", "--fields", "edge,sigma"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("'edge' of the input is replaced"), std::string::npos);
  const CloudFile after = readCloud(folder / "out.pcd");
  EXPECT_EQ(after.fields[3].name, "edge");
  EXPECT_EQ(after.fields[3].type, FieldType::Float32);
  EXPECT_LE(after.value(0, 3), 1.0);

  CloudFile list = toCloudFile(cube(3000, 0.005, 11));
  list.addField("sigma", FieldType::Float32, 3);
  save(list, folder / "list.pcd");
  EXPECT_EQ(runTool({"filter", folder / "list.pcd", "-o", folder / "x.pcd", "--fields", "sigma"}).exit_code, 5);
  EXPECT_EQ(runTool({"filter", folder / "list.pcd", "-o", folder / "x.pcd"}).exit_code, 0);
  EXPECT_EQ(runTool({"filter", folder / "in.pcd", "-o", folder / "y.pcd", "--fields", "sigma,colour"}).exit_code, 2);
  EXPECT_EQ(runTool({"filter", folder / "in.pcd", "-o", folder / "y.pcd", "--fields", "sigma,sigma"}).exit_code, 2);
  EXPECT_EQ(runTool({"filter", folder / "in.pcd", "-o", folder / "y.pcd", "--fields", "sigma,"}).exit_code, 2);
}

TEST(ToolOutliers, AreFlaggedDroppedOrKept)
{
  TemporaryFolder folder;
  const std::size_t surface = 8000, outliers = 300;
  save(toCloudFile(cubeWithOutliers(surface, outliers)), folder / "in.pcd");
  const std::string out = folder / "out.pcd";
  const json flagged = filterReport({folder / "in.pcd", "-o", out});
  const CloudFile flags = readCloud(out);
  const int field = flags.findField("outlier");
  ASSERT_GE(field, 0);
  ASSERT_EQ(flags.size(), surface + outliers);
  std::size_t right = 0, wrong = 0;
  for (std::size_t i = 0; i < flags.size(); ++i)
    (i < surface ? wrong : right) += flags.value(i, field) > 0.5;
  EXPECT_LE(wrong, surface / 200);
  EXPECT_GE(right, 2 * outliers / 3); // the others lie within the noise of a face
  EXPECT_EQ(flagged["outliers"],
            (json{{"handling", "flag"}, {"count", right + wrong}, {"dropped", 0}, {"left_out_of_data", true}}));

  const json dropped = filterReport({folder / "in.pcd", "-o", out, "--outliers", "drop"});
  const CloudFile rest = readCloud(out);
  EXPECT_EQ(rest.size(), flags.size() - right - wrong);
  EXPECT_EQ(rest.findField("outlier"), -1);
  EXPECT_EQ(dropped["outliers"]["dropped"], right + wrong);
  EXPECT_EQ(dropped["points"], rest.size());
  for (std::size_t i = 0, k = 0; i < flags.size(); ++i)
    if (!(flags.value(i, field) > 0.5)) {
      ASSERT_EQ(rest.value(k++, 0), flags.value(i, 0));
    }

  const json kept = filterReport({folder / "in.pcd", "-o", out, "--outliers", "keep"});
  EXPECT_EQ(readCloud(out).findField("outlier"), -1);
  EXPECT_EQ(readCloud(out).size(), surface + outliers);
  EXPECT_EQ(kept["outliers"]["dropped"], 0);
}

TEST(ToolFields, LengthsBeyondFloatAreWrittenAsDouble)
{
  TemporaryFolder folder;
  const CloudFile unit = toCloudFile(sphere(2000, 0.01), FieldType::Float64);
  const auto fields = [&](double scale, FieldType type) {
    CloudFile scaled = unit;
    for (std::size_t i = 0; i < unit.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        scaled.setCoordinate(i, axis, scale * unit.value(i, axis));
    save(scaled, folder / "in.ply");
    filterReport({folder / "in.ply", "-o", folder / "out.ply", "--fields", "sigma,movement"});
    CloudFile out = readCloud(folder / "out.ply");
    for (const char* name : {"sigma", "movement"}) {
      EXPECT_EQ(out.fields[static_cast<std::size_t>(out.findField(name))].type, type) << scale << " " << name;
    }
    return out;
  };
  const CloudFile plain = fields(1.0, FieldType::Float32);
  const int sigma = plain.findField("sigma");
  for (const double scale : {0x1p660, 0x1p-660}) { // about 1e200 and its inverse; powers of two round nothing
    const CloudFile scaled = fields(scale, FieldType::Float64);
    for (std::size_t i = 0; i < plain.size(); ++i)
      ASSERT_NEAR(scaled.value(i, sigma) / scale, plain.value(i, sigma), 1e-6 * plain.value(i, sigma)) << scale;
  }
}

TEST(ToolOutliers, AreNeverDroppedToNothing)
{
  TemporaryFolder folder;
  const std::string in = folder / "in.ply", out = folder / "out.ply";
  for (const std::size_t count : {2u, 3u, 10u, 47u}) { // too few to tell an outlier
    save(toCloudFile(sphere(count), FieldType::Float64), in);
    EXPECT_EQ(filterReport({in, "-o", out, "--outliers", "drop"})["outliers"]["dropped"], 0);
    EXPECT_EQ(readCloud(out).size(), count);
  }
  save(toCloudFile(sphere(60), FieldType::Float64), in);
  const ToolRun run = runTool({"filter", in, "-o", folder / "none.ply", "--outliers", "drop", "--outlier-weight", "0.9999",
                               "--radius", "4x"});
  EXPECT_EQ(run.exit_code, 5) << run.err;
  EXPECT_NE(run.err.find("all 60 points"), std::string::npos) << run.err;
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"in.ply", "out.ply"}));
}

TEST(ToolMaxMove, HoldsInTheWrittenNumbers)
{
  TemporaryFolder folder;
  for (const double offset : {0.0, 3000.0}) { // there floats come in steps of 0.00024
    const CloudFile before = toCloudFile(cubeWithOutliers(4000, 100), FieldType::Float32, {offset, offset, offset});
    save(before, folder / "in.pcd");
    const double limit = 0.004;
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--radius", "0.1"}, {"--samples", "50%", "--outliers", "keep"}}) {
      std::vector<std::string> words{folder / "in.pcd", "-o", folder / "out.pcd", "--max-move", "0.004", "--fields", "movement"};
      words.insert(words.end(), more.begin(), more.end());
      const json report = filterReport(words);
      const CloudFile after = readCloud(folder / "out.pcd");
      const int field = after.findField("movement");
      double largest = 0;
      for (std::size_t k = 0; k < after.size(); ++k)
        largest = std::max(largest, after.value(k, field));
      EXPECT_LE(report["movement"]["max"].get<double>(), limit);
      EXPECT_NEAR(report["movement"]["max"].get<double>(), largest, 1e-9);
      EXPECT_GT(report["movement"]["limited"].get<std::size_t>(), 100u);
      EXPECT_EQ(report["parameters"]["max-move"]["origin"], "user");
      if (after.size() < before.size())
        continue;
      const CloudCoordinates a = readCloud(folder / "in.pcd").coordinates(), b = after.coordinates();
      for (std::size_t i = 0; i < a.x.size(); ++i)
        ASSERT_LE(std::hypot(b.x[i] - a.x[i], b.y[i] - a.y[i], b.z[i] - a.z[i]), limit) << i;
    }
  }
}

TEST(ToolPresets, ChangeWhatTheySayAndEveryParameterHasAReason)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 4000, 0.02);
  const auto parameters = [&](const std::string& preset, const std::string& strength) {
    return filterReport({input, "-o", folder / "out.pcd", "--preset", preset, "--strength", strength})["parameters"];
  };
  const json plain = parameters("default", "1");
  EXPECT_EQ(parameters("prismatic", "1")["bilateral-iterations"]["value"], 10);
  EXPECT_EQ(parameters("freeform", "1")["bilateral-angle"]["origin"], "preset");
  EXPECT_EQ(parameters("freeform", "1")["bilateral-angle"]["value"], 60.0);
  EXPECT_EQ(plain["bilateral-angle"]["value"], 30.0);
  for (const char* name : {"radius", "fine-radius", "normal-radius", "fine-normal-radius", "bilateral-radius", "fine-bilateral-radius",
                           "max-move", "initial-variance", "iterations", "repulsion", "outlier-weight", "variance-update", "two-scales"}) {
    ASSERT_TRUE(plain.contains(name)) << name;
    EXPECT_NE(plain[name]["reason"], "") << name;
  }
  const json strong = parameters("default", "1.5");
  EXPECT_NEAR(strong["max-move"]["value"].get<double>(), 1.5 * plain["max-move"]["value"].get<double>(), 1e-9);
  EXPECT_EQ(strong["max-move"]["reason"], "6 x noise x strength 1.5");
  EXPECT_GT(strong["radius"]["value"].get<double>(), plain["radius"]["value"].get<double>());
  EXPECT_EQ(parameters("paper", "1")["max-move"]["value"], "none");
  EXPECT_EQ(runTool({"filter", input, "-o", folder / "x.pcd", "--strength", "2.5"}).exit_code, 2);
}

TEST(ToolLengths, InSpacingsAreThoseOfInfo)
{
  TemporaryFolder folder;
  const std::string input = saveNoisyCube(folder / "in.pcd", 20000, 0.02); // so much noise widens the distances of neighbours
  const double spacing = json::parse(runTool({"info", input, "--json"}).out)["spacing"].get<double>();
  const json report = filterReport({input, "-o", folder / "out.pcd", "--max-move", "4x"});
  EXPECT_NEAR(report["parameters"]["max-move"]["value"].get<double>(), 4 * spacing, 1e-6 * spacing);
}

} // namespace
} // namespace pcl_gpf::test
