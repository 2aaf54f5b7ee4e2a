// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/metrics.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <limits>

namespace pcl_gpf {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(DistanceSummary, ofFiveKnownDistances)
{
  const auto summary = summarizeDistances({-2, 0, 1, kNaN, 4, -3, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(summary.count, 5u);
  EXPECT_EQ(summary.left_out, 2u);
  EXPECT_DOUBLE_EQ(summary.mean, 2.0);
  EXPECT_DOUBLE_EQ(summary.signed_mean, 0.0);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(30.0 / 5));
  EXPECT_DOUBLE_EQ(summary.max, 4.0);
  EXPECT_DOUBLE_EQ(summary.p95, 3.8); // rank 0.95 * 4 = 3.8 between 3 and 4
}

TEST(DistanceSummary, ofRanksZeroToHundred)
{
  std::vector<double> distances;
  for (int i = 100; i >= 0; --i)
    distances.push_back(i);
  EXPECT_DOUBLE_EQ(summarizeDistances(distances).p95, 95.0);
}

TEST(DistanceSummary, ofNothingAndOfZeros)
{
  EXPECT_EQ(summarizeDistances({}).count, 0u);
  const auto nothing_finite = summarizeDistances({kNaN});
  EXPECT_EQ(nothing_finite.left_out, 1u);
  EXPECT_EQ(nothing_finite.mean, 0.0);
  const auto zeros = summarizeDistances({0, 0});
  EXPECT_EQ(zeros.count, 2u);
  EXPECT_EQ(zeros.rms, 0.0);
}

TEST(DistanceSummary, scalesWithTheUnit)
{
  SplitMix64 random(1);
  std::vector<double> distances(1000);
  for (double& distance : distances)
    distance = random.normal();
  const auto reference = summarizeDistances(distances);
  for (const double scale : {0x1p-600, 0x1p-20, 0x1p20, 0x1p600}) {
    std::vector<double> scaled = distances;
    for (double& distance : scaled)
      distance *= scale;
    const auto summary = summarizeDistances(scaled);
    EXPECT_DOUBLE_EQ(summary.mean, reference.mean * scale);
    EXPECT_DOUBLE_EQ(summary.rms, reference.rms * scale);
    EXPECT_DOUBLE_EQ(summary.p95, reference.p95 * scale);
    EXPECT_DOUBLE_EQ(summary.max, reference.max * scale);
  }
}

TEST(RowDistances, goRowByRow)
{
  const auto distances = rowDistances({{0, 0, 0}, {1, 1, 1}, {kNaN, 0, 0}}, {{3, 4, 0}, {1, 1, 1}, {0, 0, 0}});
  EXPECT_EQ(distances[0], 5.0);
  EXPECT_EQ(distances[1], 0.0);
  EXPECT_TRUE(std::isnan(distances[2]));
  EXPECT_THROW(rowDistances({{0, 0, 0}}, {}), InvalidParameter);
}

} // namespace
} // namespace pcl_gpf
