// SPDX-License-Identifier: BSD-3-Clause
// Every file of the shared corpus gives what its manifest says: the points, the finite ones and their sums, or IoError.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>

#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"

namespace pcl_gpf {
namespace {

struct ManifestRow {
  std::string file;
  bool is_error = false;
  bool error_is_fine = false;
  std::size_t points = 0;
  std::size_t finite = 0;
  double sums[3] = {};
};

const std::string kFolder = std::string(PCL_GPF_SHARED_DIR) + "/badcloud/";

std::vector<ManifestRow> readManifest() {
  std::ifstream manifest(kFolder + "manifest.tsv");
  std::vector<ManifestRow> rows;
  std::string line;
  std::getline(manifest, line); // titles
  while (std::getline(manifest, line)) {
    std::vector<std::string> columns;
    std::istringstream stream(line);
    for (std::string column; std::getline(stream, column, '\t');)
      columns.push_back(column);
    columns.resize(10);
    ManifestRow row;
    row.file = columns[0];
    row.is_error = columns[2] == "error";
    row.error_is_fine = columns[3] == "error";
    if (!row.is_error) {
      row.points = std::stoul(columns[2].substr(3));
      row.finite = std::stoul(columns[4]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        row.sums[axis] = std::stod(columns[5 + axis]);
    }
    rows.push_back(row);
  }
  return rows;
}

void expectCloud(const ManifestRow& row, const CloudFile& cloud) {
  EXPECT_EQ(cloud.size(), row.points);
  EXPECT_EQ(cloud.finiteCount(), row.finite);
  const CloudCoordinates all = cloud.coordinates();
  const std::vector<double>* axes[3] = {&all.x, &all.y, &all.z};
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    double magnitudes = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!std::isfinite(all.x[i]) || !std::isfinite(all.y[i]) || !std::isfinite(all.z[i])) continue;
      sum += (*axes[axis])[i];
      magnitudes += std::abs((*axes[axis])[i]);
    }
    // The manifest adds the digits of text files as doubles; a field that is declared float holds them rounded.
    constexpr double kFloatRounding = 0x1p-24;
    const double tolerance = std::max({1e-6, 1e-6 * std::abs(row.sums[axis]), kFloatRounding * magnitudes});
    EXPECT_NEAR(sum, row.sums[axis], tolerance) << "axis " << axis;
  }
}

TEST(Corpus, EveryFileGivesWhatTheManifestSays) {
  const std::vector<ManifestRow> rows = readManifest();
  if (rows.empty()) GTEST_SKIP() << "no corpus in " << kFolder;
  for (const ManifestRow& row : rows) {
    SCOPED_TRACE(row.file);
    const auto start = std::chrono::steady_clock::now();
    // All coordinates of this file are NaN. It is readable; that it is of no use is for the tool to say.
    const bool only_the_tool_refuses = row.file == "ply_all_nan_le.ply";
    try {
      const CloudFile cloud = readCloud(kFolder + row.file);
      if (only_the_tool_refuses) {
        EXPECT_EQ(cloud.finiteCount(), 0U);
      } else if (row.is_error) {
        ADD_FAILURE() << "a broken file was accepted";
      } else {
        expectCloud(row, cloud);
      }
    } catch (const IoError& error) {
      EXPECT_TRUE(row.is_error || row.error_is_fine) << error.what();
      EXPECT_EQ(error.kind(), IoErrorKind::Unreadable);
      EXPECT_NE(std::string(error.what()).find(row.file), std::string::npos) << error.what();
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 1.0);
  }
}

TEST(Corpus, AnAcceptableErrorIsNotNeeded) {
  // Files that a reader may refuse, but that this one reads: a change here should be a decision.
  const std::vector<ManifestRow> rows = readManifest();
  if (rows.empty()) GTEST_SKIP() << "no corpus in " << kFolder;
  for (const ManifestRow& row : rows) {
    if (row.is_error) continue;
    EXPECT_NO_THROW(readCloud(kFolder + row.file)) << row.file;
  }
}

} // namespace
} // namespace pcl_gpf
