// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {
namespace {

TEST(SplitMix64, givesThePublishedSequence)
{
  // First values of Vigna's reference implementation for these seeds.
  SplitMix64 zero(0);
  EXPECT_EQ(zero.next(), 0xe220a8397b1dcdafull);
  EXPECT_EQ(zero.next(), 0x6e789e6aa1b965f4ull);
  EXPECT_EQ(zero.next(), 0x06c45d188009454full);
  SplitMix64 other(1234567);
  EXPECT_EQ(other.next(), 6457827717110365317ull);
  EXPECT_EQ(other.next(), 3203168211198807973ull);
}

TEST(SplitMix64, isUniform)
{
  constexpr std::size_t kBins = 100, kDraws = 200000;
  for (const bool integers : {false, true}) {
    SplitMix64 random(42);
    std::vector<double> bins(kBins, 0.0);
    for (std::size_t i = 0; i < kDraws; ++i) {
      const double u = integers ? 0 : random.uniform();
      ASSERT_TRUE(u >= 0.0 && u < 1.0);
      ++bins[integers ? random.below(kBins) : static_cast<std::size_t>(u * kBins)];
    }
    double chi_squared = 0.0;
    for (const double count : bins)
      chi_squared += std::pow(count - kDraws / kBins, 2) / (kDraws / kBins);
    // 99 degrees of freedom: mean 99, standard deviation 14; 6 of them either way.
    EXPECT_GT(chi_squared, 99 - 6 * 14.1);
    EXPECT_LT(chi_squared, 99 + 6 * 14.1);
  }
}

TEST(SplitMix64, belowReachesEveryValueAndNoOther)
{
  SplitMix64 random(5);
  for (const std::uint64_t bound : {1ull, 2ull, 3ull, 7ull}) {
    std::vector<int> seen(bound, 0);
    for (int i = 0; i < 200; ++i) {
      const std::uint64_t value = random.below(bound);
      ASSERT_LT(value, bound);
      seen[value] = 1;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(bound));
  }
  // A bound just above 2^63 rejects almost half of the draws.
  const std::uint64_t large = (1ull << 63) + 1;
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(random.below(large), large);
}

TEST(SplitMix64, normalHasTheMomentsOfTheNormalDistribution)
{
  constexpr int kDraws = 400000;
  SplitMix64 random(9);
  double sums[5] = {};
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.normal();
    ASSERT_TRUE(std::isfinite(value));
    beyond_two += std::abs(value) > 2.0;
    for (int power = 1; power <= 4; ++power)
      sums[power] += std::pow(value, power) / kDraws;
  }
  EXPECT_NEAR(sums[1], 0.0, 0.01); // 6 standard errors each
  EXPECT_NEAR(sums[2], 1.0, 0.015);
  EXPECT_NEAR(sums[3], 0.0, 0.04);
  EXPECT_NEAR(sums[4], 3.0, 0.1);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.002);
}

TEST(RandomSubset, isTheSameForOneSeedEverywhere)
{
  EXPECT_EQ(randomSubset(20, 6, 1), (std::vector<std::uint32_t>{4, 5, 9, 13, 14, 15}));
  EXPECT_EQ(randomSubset(20, 6, 2), randomSubset(20, 6, 2));
  EXPECT_NE(randomSubset(2000, 600, 1), randomSubset(2000, 600, 2));
}

TEST(RandomSubset, isAscendingAndDistinct)
{
  for (const std::size_t count : {0u, 1u, 500u, 999u, 1000u, 1500u}) {
    const auto subset = randomSubset(1000, count, 3);
    ASSERT_EQ(subset.size(), std::min<std::size_t>(count, 1000));
    for (std::size_t i = 1; i < subset.size(); ++i)
      ASSERT_LT(subset[i - 1], subset[i]);
    if (!subset.empty()) {
      EXPECT_LT(subset.back(), 1000u);
    }
  }
  EXPECT_TRUE(randomSubset(0, 5, 1).empty());
}

TEST(RandomSubset, takesEveryIndexEquallyOften)
{
  constexpr int kRounds = 20000;
  std::vector<int> chosen(10, 0);
  for (int seed = 0; seed < kRounds; ++seed)
    for (const std::uint32_t i : randomSubset(10, 3, static_cast<std::uint64_t>(seed)))
      ++chosen[i];
  for (const int count : chosen) // mean 6000, standard deviation 65
    EXPECT_NEAR(count, 0.3 * kRounds, 6 * 65);
}

} // namespace
} // namespace pcl_gpf
