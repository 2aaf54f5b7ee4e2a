// SPDX-License-Identifier: BSD-3-Clause
#include "spelling.h"

#include <algorithm>
#include <cstddef>

namespace pcl_gpf {

namespace {

/** Optimal string alignment distance: insertions, deletions, replacements and swaps of neighbours. */
std::size_t
editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

} // namespace

std::string
nearestSpelling(const std::string& word, const std::vector<std::string>& candidates)
{
  constexpr std::size_t kLongestName = 40;
  if (word.empty() || word.size() > kLongestName)
    return "";
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string shortest;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(word, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
    const bool begins = word.size() > 1 && candidate.compare(0, word.size(), word) == 0;
    if (begins && (shortest.empty() || candidate.size() < shortest.size()))
      shortest = candidate;
  }
  return nearest.empty() ? shortest : nearest;
}

} // namespace pcl_gpf
