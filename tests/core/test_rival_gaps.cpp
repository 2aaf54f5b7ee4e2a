// SPDX-License-Identifier: BSD-3-Clause
#include "core/operators/rival_gaps.h"

#include <pcl_gpf/core/sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pcl_gpf::test {
namespace {

/** Taken one after another by priority, unless one that was taken lies within the clearance. */
std::vector<std::uint32_t>
oneAfterAnother(const std::vector<Gap>& gaps, std::vector<std::uint32_t> rivals)
{
  std::stable_sort(rivals.begin(), rivals.end(), [&](std::uint32_t a, std::uint32_t b) { return gaps[a].priority > gaps[b].priority; });
  std::vector<std::uint32_t> taken;
  for (const std::uint32_t k : rivals) {
    const auto reaches = [&](std::uint32_t j) {
      float distance_sq = 0.0f;
      for (std::size_t axis = 0; axis < 3; ++axis)
        distance_sq += (gaps[k].base[axis] - gaps[j].base[axis]) * (gaps[k].base[axis] - gaps[j].base[axis]);
      return distance_sq < gaps[k].clearance_sq;
    };
    if (std::none_of(taken.begin(), taken.end(), reaches))
      taken.push_back(k);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

TEST(RivalGaps, AreThoseThatOneAfterAnotherWouldFill)
{
  SplitMix64 random(5);
  std::vector<Gap> gaps(4000);
  std::vector<std::uint32_t> rivals;
  for (std::uint32_t k = 0; k < gaps.size(); ++k) {
    for (float& coordinate : gaps[k].base)
      coordinate = static_cast<float>(random.uniform());
    gaps[k].base[2] *= 0.01f;
    const double clearance = 0.01 + 0.05 * random.uniform();
    gaps[k].clearance_sq = static_cast<float>(clearance * clearance);
    gaps[k].priority = k % 7 == 0 ? 0.5f : static_cast<float>(random.uniform()); // some are equal
    if (k % 11 == 0 && k > 0)
      gaps[k].base = gaps[k - 1].base;
    if (k % 3 != 0)
      rivals.push_back(k);
  }
  const std::vector<std::uint32_t> expected = oneAfterAnother(gaps, rivals);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_LT(expected.size(), rivals.size() / 2);
  for (const std::size_t threads : {std::size_t{1}, std::size_t{3}})
    EXPECT_EQ(fillableTogether(gaps, rivals, threads), expected);
  EXPECT_TRUE(fillableTogether(gaps, {}, 1).empty());
  EXPECT_EQ(fillableTogether(gaps, {7}, 1), std::vector<std::uint32_t>{7});
}

} // namespace
} // namespace pcl_gpf::test
