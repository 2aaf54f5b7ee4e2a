// SPDX-License-Identifier: BSD-3-Clause
// Every file of the shared corpus: info tells what the manifest says, filter ends in time with a documented exit code.
#include "run_tool.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pcl_gpf::test {
namespace {

using nlohmann::json;

const std::string kCorpus = std::string(PCL_GPF_SHARED_DIR) + "/badcloud/";

/** Rows of the manifest: file, what is wrong, expected, also acceptable, finite, sums of x, y, z. */
std::vector<std::vector<std::string>>
manifestRows()
{
  std::ifstream manifest(kCorpus + "manifest.tsv");
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(manifest, line);
  while (std::getline(manifest, line)) {
    std::vector<std::string> columns;
    std::istringstream stream(line);
    for (std::string column; std::getline(stream, column, '\t');)
      columns.push_back(column);
    columns.resize(8);
    rows.push_back(columns);
  }
  return rows;
}

void
expectInfo(const std::vector<std::string>& row, const json& info)
{
  EXPECT_EQ("ok " + std::to_string(info["points"].get<std::size_t>()) + " points", row[2]);
  EXPECT_EQ(std::to_string(info["finite"].get<std::size_t>()), row[4]);
  const double finite = info["finite"].get<double>();
  for (std::size_t axis = 0; axis < 3 && finite > 0.0; ++axis) {
    const double expected = std::stod(row[5 + axis]);
    const double largest = std::max(std::abs(info["min"][axis].get<double>()), std::abs(info["max"][axis].get<double>()));
    // The manifest adds the digits of text files as doubles; a field that is declared float holds them rounded.
    const double tolerance = std::max({1e-6, 1e-6 * std::abs(expected), 0x1p-24 * finite * largest});
    EXPECT_NEAR(info["mean"][axis].get<double>() * finite, expected, tolerance) << "axis " << axis;
  }
}

TEST(ToolCorpus, InfoTellsWhatTheManifestSays)
{
  const auto rows = manifestRows();
  if (rows.empty())
    GTEST_SKIP() << "no corpus in " << kCorpus;
  for (const auto& row : rows) {
    SCOPED_TRACE(row[0]);
    RunSetup setup;
    setup.limit_seconds = 5.0;
    const ToolRun run = runTool({"info", kCorpus + row[0], "--json"}, setup);
    const bool refused = run.exit_code == 3 || run.exit_code == 5;
    if (row[2] == "error" || (row[3] == "error" && refused))
      EXPECT_TRUE(refused) << run.exit_code << run.err;
    else if (run.exit_code == 0)
      expectInfo(row, json::parse(run.out));
    else
      ADD_FAILURE() << "exit code " << run.exit_code << " signal " << run.signal << ": " << run.err;
  }
}

TEST(ToolCorpus, FilterEndsWithADocumentedCodeAndLeavesNothingOnError)
{
  const auto rows = manifestRows();
  if (rows.empty())
    GTEST_SKIP() << "no corpus in " << kCorpus;
  for (const auto& row : rows) {
    SCOPED_TRACE(row[0]);
    TemporaryFolder folder;
    RunSetup setup;
    setup.limit_seconds = 10.0;
    const ToolRun run = runTool({"filter", kCorpus + row[0], "-o", folder / "out.ply"}, setup);
    EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 3 || run.exit_code == 5)
        << "exit code " << run.exit_code << " signal " << run.signal << ": " << run.err;
    EXPECT_EQ(folder.entries().size(), run.exit_code == 0 ? 1u : 0u);
    if (row[2] == "error") {
      EXPECT_NE(run.exit_code, 0);
    }
  }
}

} // namespace
} // namespace pcl_gpf::test
