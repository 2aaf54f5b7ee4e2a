// SPDX-License-Identifier: BSD-3-Clause
#include "charts.h"
#include "options.h"
#include "parameter_changes.h"
#include "report.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
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
