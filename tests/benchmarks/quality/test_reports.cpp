// SPDX-License-Identifier: BSD-3-Clause
#include "bar_chart.h"
#include "charts.h"
#include "options.h"
#include "parameter_changes.h"
#include "peer_comparison.h"
#include "report.h"
#include "result_cloud.h"
#include "targets.h"

#include <pcl_gpf/io/read_cloud.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <unistd.h>

namespace pcl_gpf::quality {
namespace {

Record
record(const char* model, double percent, const char* method, double mean)
{
  Record r;
  r.model = model;
  r.size = 33490;
  r.noise.percent = percent;
  r.method = method;
  r.figures.mean = mean;
  return r;
}

std::size_t
fieldsOf(const std::string& line)
{
  return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
}

std::size_t
countOf(const std::string& text, const std::string& what)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

TEST(QualityReport, CsvHasAFieldForEveryHeading)
{
  const std::string line = csvLine(record("cube", 0.25, "ours", 3.5));
  EXPECT_EQ(fieldsOf(line), fieldsOf(csvHeading()));
  EXPECT_EQ(line.find("cube,33490,gaussian,0.25,0,1,ours,,0,3.5,,"), 0u) << line;
}

TEST(QualityReport, CsvIsReadAsItWasWritten)
{
  const std::string path = ::testing::TempDir() + "quality_" + std::to_string(getpid()) + ".csv";
  Record r = record("sheets:6", 1.5, "wlop-best", 1.0 / 3);
  r.noise = {NoiseKind::Scanner, 1.5, 0.05, 7};
  r.setting = "r 3.00 %";
  std::ofstream(path) << csvHeading() << "\n" << csvLine(r) << "\n";
  const std::vector<Record> read = readCsv(path);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(csvLine(read[0]), csvLine(r));
  EXPECT_TRUE(std::isnan(read[0].figures.recession));
  std::ofstream(path) << "x,y\n1,2\n";
  EXPECT_THROW(readCsv(path), std::runtime_error);
  std::filesystem::remove(path);
}

TEST(QualityReport, ComparesWithTheBestTunedPeerOfEachCloud)
{
  const std::vector<Record> records = {record("cube", 1, "input", 8),         record("cube", 1, "ours", 3),
                                       record("cube", 1, "mls-best", 2),      record("cube", 1, "wlop-best", 4),
                                       record("cube", 1, "mls", 1),           record("cube", 0.5, "ours", 1),
                                       record("cube", 0.5, "jet-best", 1),    record("cube", 0.5, "ours:one-scale", 2),
                                       record("torus", 0.5, "jet-best", 0.1), record("cap", 0.5, "ours", 9)};
  const std::vector<PeerComparison> compared = compareWithPeers(records);
  ASSERT_EQ(compared.size(), 2u); // nothing to compare on torus and cap
  EXPECT_EQ(compared[0].peer, &records[2]);
  EXPECT_FALSE(compared[0].holds());
  EXPECT_EQ(compared[1].ours, &records[5]);
  EXPECT_EQ(compared[1].peer, &records[6]);
  EXPECT_TRUE(compared[1].holds()); // as good is not worse
  const std::string table = peerTable(compared);
  EXPECT_EQ(countOf(table, "WORSE than mls-best"), 1u) << table;
  EXPECT_EQ(countOf(table, "1 of 2 clouds"), 1u) << table;
}

TEST(QualityReport, TableLinesAlignWithTheirHeading)
{
  EXPECT_EQ(tableLine(record("cube", 0.25, "ours", 3.5)).size(), tableHeading().size());
}

TEST(QualityCharts, OneFileAModelWithALineAMethod)
{
  const std::vector<Chart> charts =
      drawCharts({record("cube", 1, "input", 78), record("cube", 0.5, "input", 39), record("cube", 1, "ours", 8),
                  record("cube", 0.5, "ours", 6), record("sphere", 1, "a<b", 5), record("torus", 0, "ours", 1)});
  ASSERT_EQ(charts.size(), 2u) << "a model without noise has no curve";
  EXPECT_EQ(charts[0].file_name, "quality_cube.svg");
  EXPECT_EQ(charts[1].file_name, "quality_sphere.svg");
  EXPECT_EQ(countOf(charts[0].svg, "<circle"), 3u) << "two points and the legend";
  EXPECT_EQ(countOf(charts[0].svg, ">input</text>"), 1u);
  EXPECT_NE(charts[1].svg.find("a&lt;b"), std::string::npos);
  for (const Chart& chart : charts)
    EXPECT_EQ(chart.svg.find("nan"), std::string::npos);
}

TEST(QualityBars, HeightsAreProportionalAndValuesAreWritten)
{
  const std::string svg = drawBars("t", {{"p", {{"ours", 2}, {"a<b", 8}}}, {"none", {{"zero", 0}}}});
  EXPECT_EQ(countOf(svg, "height=\"170.0\""), 1u) << "the largest bar of the first panel";
  EXPECT_EQ(countOf(svg, "height=\"42.5\""), 1u);
  EXPECT_EQ(countOf(svg, "height=\"0.0\""), 1u);
  EXPECT_NE(svg.find(">8</text>"), std::string::npos);
  EXPECT_NE(svg.find("a&lt;b"), std::string::npos);
}

TEST(QualityClouds, HoldFinitePointsNormalsAndDistances)
{
  const NoisyCloud cloud = makeNoisyCloud(makeModel("plane", 10), 10, {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  MethodResult result;
  result.points = {{0.5, 0.5, 0.25}, {nan, 0, 0}, {0.25, 0.5, 0}};
  result.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, -1}};
  const std::string path = ::testing::TempDir() + "quality_" + std::to_string(getpid()) + ".ply";
  writeResultCloud(path, cloud, result);
  const CloudFile read = readCloud(path);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_TRUE(read.hasNormals());
  EXPECT_EQ(read.coordinates().x, (std::vector<double>{0.5, 0.25}));
  EXPECT_NEAR(read.value(0, read.findField("distance")), 0.25e4 / std::sqrt(2), 1e-3);
  EXPECT_EQ(read.value(1, read.findField("distance")), 0);
  result.normals.clear();
  writeResultCloud(path, cloud, result);
  EXPECT_FALSE(readCloud(path).hasNormals());
  std::filesystem::remove(path);
}

TEST(QualityClouds, AreNamedAfterTheirRecords)
{
  Record r = record("cube", 1.5, "ours:h=8+iterations=3", 1);
  EXPECT_EQ(cloudFileName(r), "cube_1.5_ours_h_8_iterations_3.ply");
  r.noise = {NoiseKind::Uniform, 0.5, 0.1, 1};
  r.size = 6000;
  EXPECT_EQ(cloudFileName(r), "cube_uniform_6000_10_outliers_0.5_ours_h_8_iterations_3.ply");
}

TEST(QualityTargets, VerdictsFollowTheFigures)
{
  const Target target = {"cube", 1, "mean", nullptr, 10, 8};
  const std::string table = targetTable({{target, 7}, {target, 9}, {target, 11}, {target, Figures::kNone}});
  EXPECT_EQ(countOf(table, "  aim\n"), 1u);
  EXPECT_EQ(countOf(table, "  must\n"), 1u);
  EXPECT_EQ(countOf(table, "  FAILS\n"), 2u) << "a figure that is missing fails";
  EXPECT_NE(table.find("2 of 4 figures fall short"), std::string::npos);
}

TEST(QualityTargets, CoverEveryModelOnce)
{
  const std::vector<Target> targets = allTargets();
  for (const Target& t : targets) {
    EXPECT_NO_THROW(makeModel(t.model, 1000)) << t.model;
    EXPECT_EQ(std::count_if(
                  targets.begin(), targets.end(),
                  [&](const Target& o) { return o.model == t.model && o.percent == t.percent && o.name == t.name; }),
              1);
  }
}

TEST(QualityOptions, ListsAndGroups)
{
  const Options o =
      parseOptions({"--models", "cube,analytic", "--noises", "0.1,3", "--kinds", "scanner,uniform", "--sizes", "10,20",
                    "--outliers", "0,5", "--methods", "paper,ours:no-symmetric+iterations=3", "--seed", "9"});
  EXPECT_EQ(o.models.size(), 12u);
  EXPECT_EQ(o.noises, (std::vector<double>{0.1, 3}));
  EXPECT_EQ(o.kinds, (std::vector<NoiseKind>{NoiseKind::Scanner, NoiseKind::Uniform}));
  EXPECT_EQ(o.outliers, (std::vector<double>{0, 0.05}));
  EXPECT_EQ(o.seed, 9u);
}

/** tools/reproduce_paper.sh spells these. */
TEST(QualityOptions, KnowTheMethodsOfThePapersFigures)
{
  EXPECT_NO_THROW(parseOptions({"--methods", "rimls,rimls-best,paper:repulsion-weight=0+outlier-weight=0.9,"
                                             "ours:posterior+keep-outliers+h=20+outlier-weight=0.9,"
                                             "ours:sample-ratio=0.5+iterations=30+repulsion-weight=0.3,"
                                             "ours:sample-ratio=0.5+iterations=30+plain-repulsion"}));
}

TEST(QualityOptions, RefuseWhatTheyDoNotKnow)
{
  const std::vector<std::vector<std::string>> wrong = {
      {"--model", "cube"}, {"--noises", "much"},    {"--noises", "-1"},           {"--kinds", "pink"},
      {"--sizes", "1.5"},  {"--methods", "theirs"}, {"--methods", "ours:faster"}, {"--methods", "ours:iterations=few"},
      {"--seed"},          {"--outliers", "nan"}};
  for (const auto& arguments : wrong)
    EXPECT_THROW(parseOptions(arguments), std::invalid_argument) << arguments.front() << " " << arguments.back();
}

TEST(QualityParameterChanges, ReachTheirFields)
{
  const NoisyCloud cloud = makeNoisyCloud(makeModel("cube", 10), 10, {});
  DenoiseParameters p;
  parseChanges("no-symmetric+h=2+iterations=3")(p, cloud);
  EXPECT_EQ(p.gpf.data_term, DataTerm::PointToPlane);
  EXPECT_DOUBLE_EQ(p.gpf.support_radius, 0.02 * std::sqrt(3));
  EXPECT_EQ(p.gpf.maximum_iterations, 3u);
}

} // namespace
} // namespace pcl_gpf::quality
