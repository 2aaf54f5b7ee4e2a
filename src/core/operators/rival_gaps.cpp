// SPDX-License-Identifier: BSD-3-Clause
#include "rival_gaps.h"

#include "patches.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kGapsPerTask = 256;

/** Gaps in the order of an index over their bases. */
struct SortedGaps {
  PointsView bases;
  std::vector<std::uint32_t> number;
  std::vector<float> clearance_sq, priority;

  SortedGaps(const PointIndex& index, const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals)
  : bases(index.sorted()), number(rivals.size()), clearance_sq(rivals.size()), priority(rivals.size())
  {
    for (std::size_t k = 0; k < rivals.size(); ++k) {
      number[k] = rivals[index.order()[k]];
      clearance_sq[k] = gaps[number[k]].clearance_sq;
      priority[k] = gaps[number[k]].priority;
    }
  }
  bool better(std::size_t j, std::size_t k) const
  {
    return priority[j] > priority[k] || (priority[j] == priority[k] && number[j] < number[k]);
  }
  bool isBest(std::size_t k, const std::vector<Run>& candidates) const
  {
    for (const Run run : candidates)
      for (std::uint32_t j = run.begin; j < run.end; ++j) {
        const float dx = bases.x[j] - bases.x[k], dy = bases.y[j] - bases.y[k], dz = bases.z[j] - bases.z[k];
        if (dx * dx + dy * dy + dz * dz < clearance_sq[k] && j != k && better(j, k))
          return false;
      }
    return true;
  }
};

SoaBuffer
basesOf(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals)
{
  SoaBuffer bases(rivals.size());
  for (std::size_t r = 0; r < rivals.size(); ++r) {
    bases.x[r] = gaps[rivals[r]].base[0];
    bases.y[r] = gaps[rivals[r]].base[1];
    bases.z[r] = gaps[rivals[r]].base[2];
  }
  return bases;
}

} // namespace

std::vector<std::uint32_t>
bestWithinClearance(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals, std::size_t threads)
{
  const SoaBuffer bases = basesOf(gaps, rivals);
  const PointIndex index(bases.view(), static_cast<unsigned>(threads));
  const SortedGaps sorted(index, gaps, rivals);
  std::vector<std::uint8_t> wins(rivals.size());
  parallelBlocks(rivals.size(), kGapsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    const auto clearances = sorted.clearance_sq.begin();
    const float reach = std::sqrt(*std::max_element(clearances + static_cast<std::ptrdiff_t>(begin), clearances + static_cast<std::ptrdiff_t>(end)));
    const auto position = [&](std::size_t k) {
      return std::array<float, 3>{sorted.bases.x[k], sorted.bases.y[k], sorted.bases.z[k]};
    };
    std::vector<Run> candidates;
    forPatches(begin, end, 2.0f * reach, position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
      candidates.clear();
      index.tree().collectRuns(box, reach, candidates);
      for (std::size_t k = first; k < last; ++k)
        wins[k] = sorted.isBest(k, candidates);
    });
  });
  std::vector<std::uint32_t> best;
  for (std::size_t k = 0; k < wins.size(); ++k)
    if (wins[k])
      best.push_back(sorted.number[k]);
  return best;
}

} // namespace pcl_gpf
