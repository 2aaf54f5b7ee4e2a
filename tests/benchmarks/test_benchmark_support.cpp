// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/benchmark_statistics.h"
#include "benchmarks/end_to_end_options.h"
#include "benchmarks/model_cloud.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

namespace {

using namespace pcl_gpf;
using benchmark_models::ModelCloud;
using benchmark_models::Surroundings;

TEST(BenchmarkStatistics, MedianAndSlopeOfKnownNumbers)
{
  EXPECT_EQ(benchmark_statistics::median({3, 1, 2}), 2);
  EXPECT_EQ(benchmark_statistics::median({4, 1, 2, 3}), 2.5);
  EXPECT_NEAR(benchmark_statistics::logarithmicSlope({1, 10, 100}, {5, 50, 500}), 1.0, 1e-12);
  EXPECT_NEAR(benchmark_statistics::logarithmicSlope({1, 4, 16}, {2, 16, 128}), 1.5, 1e-12);
}

TEST(BenchmarkModels, BallsHoldTheNeighborsWanted)
{
  const std::size_t size = 3000;
  const ModelCloud cloud("block", size, 1.0);
  const Surroundings around(cloud);
  for (const double wanted : {5.0, 60.0}) {
    // It is the distance of some pair: a hair more, so that rounding does not decide on that pair.
    const double radius = around.radiusOfNeighbors(wanted) * (1 + 1e-5);
    double pairs = 0;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        const double dx = cloud.x[i] - cloud.x[j], dy = cloud.y[i] - cloud.y[j], dz = cloud.z[i] - cloud.z[j];
        pairs += dx * dx + dy * dy + dz * dz < radius * radius;
      }
    EXPECT_NEAR(pairs / size, wanted, 0.05 * wanted);
    std::vector<std::uint32_t> all(size);
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_NEAR(around.pairsWithin(radius, all), pairs, 1e-4 * pairs);
  }
  EXPECT_THROW(around.radiusOfNeighbors(size), std::invalid_argument);
  EXPECT_THROW(around.radiusOfNeighbors(0.0), std::invalid_argument);
}

TEST(BenchmarkOptions, WrongOnesAreRefused)
{
  const auto parse = [](std::vector<const char*> words) {
    words.insert(words.begin(), "end_to_end");
    return benchmark_options::parse(static_cast<int>(words.size()), const_cast<char**>(words.data()));
  };
  const auto o = parse({"--sizes", "100,2000", "--slope", "--neighbors", "60"});
  EXPECT_EQ(o.sizes, (std::vector<std::size_t>{100, 2000}));
  EXPECT_TRUE(o.slope);
  EXPECT_EQ(o.neighbors, 60.0);
  EXPECT_THROW(parse({"--sizes", "100,"}), std::invalid_argument);
  EXPECT_THROW(parse({"--sizes", "0"}), std::invalid_argument);
  EXPECT_THROW(parse({"--sizes", "100", "--slope"}), std::invalid_argument);
  EXPECT_THROW(parse({"--threads", "1", "--threads-compare"}), std::invalid_argument);
  EXPECT_THROW(parse({"--model"}), std::invalid_argument);
  EXPECT_THROW(parse({"--model", "teapot"}), std::invalid_argument);
}

} // namespace
