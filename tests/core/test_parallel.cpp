// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace pcl_gpf {
namespace {

using Blocks = std::vector<std::pair<std::size_t, std::size_t>>;

/** The blocks that the body saw, ascending. */
Blocks
blocksOf(std::size_t count, std::size_t block, std::size_t threads)
{
  Blocks blocks;
  std::mutex mutex;
  parallelBlocks(count, block, threads, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard<std::mutex> lock(mutex);
    blocks.emplace_back(begin, end);
  });
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

TEST(ParallelBlocks, coversEveryIndexOnceInBlocksThatDoNotDependOnThreads)
{
  for (const std::size_t count : {0u, 1u, 99u, 100u, 101u, 1234u}) {
    Blocks expected;
    for (std::size_t begin = 0; begin < count; begin += 100)
      expected.emplace_back(begin, std::min<std::size_t>(count, begin + 100));
    for (std::size_t threads = 0; threads <= 7; ++threads)
      EXPECT_EQ(blocksOf(count, 100, threads), expected) << count << " values, " << threads << " threads";
  }
}

TEST(ParallelBlocks, throwsTheExceptionOfTheBody)
{
  for (const std::size_t threads : {1u, 2u, 7u})
    try {
      parallelBlocks(1000, 10, threads, [](std::size_t begin, std::size_t) {
        if (begin == 500)
          throw std::out_of_range("block 500");
      });
      FAIL() << threads << " threads";
    } catch (const std::out_of_range& e) {
      EXPECT_STREQ(e.what(), "block 500");
    }
}

TEST(ParallelBlocks, worksInsideItself)
{
  std::vector<int> visits(40 * 30, 0);
  parallelBlocks(40, 1, 3, [&](std::size_t row, std::size_t) {
    parallelBlocks(30, 4, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t column = begin; column < end; ++column)
        ++visits[row * 30 + column];
    });
  });
  EXPECT_EQ(visits, std::vector<int>(40 * 30, 1));
}

TEST(ParallelBlocks, worksFromSeveralThreadsAtOnce)
{
  std::atomic<std::size_t> sum{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int call = 0; call < 20; ++call)
        parallelBlocks(1000, 7, 3, [&](std::size_t begin, std::size_t end) { sum += end - begin; });
    });
  for (std::thread& caller : callers)
    caller.join();
  EXPECT_EQ(sum, 4u * 20u * 1000u);
}

TEST(ParallelBlocks, givesPartialSumsOfTheSameBitsForAnyNumberOfThreads)
{
  SplitMix64 random(1);
  std::vector<float> values(100000);
  for (float& value : values)
    value = static_cast<float>(random.normal());
  const auto sum = [&](std::size_t threads) {
    std::vector<float> partials((values.size() + 4095) / 4096);
    parallelBlocks(values.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        partials[begin / 4096] += values[i];
    });
    return std::accumulate(partials.begin(), partials.end(), 0.0f);
  };
  const float expected = sum(1);
  for (std::size_t threads = 2; threads <= 7; ++threads)
    EXPECT_EQ(sum(threads), expected);
}

TEST(ResolveThreads, keepsTheNumberWithinBounds)
{
  EXPECT_GE(resolveThreads(0), 1u);
  EXPECT_EQ(resolveThreads(1), 1u);
  EXPECT_EQ(resolveThreads(7), 7u);
  EXPECT_EQ(resolveThreads(1000000), 1024u);
}

} // namespace
} // namespace pcl_gpf
