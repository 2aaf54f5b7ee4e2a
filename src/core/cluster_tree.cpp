// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>

#include "kernels/kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPacksPerTask = 512;
constexpr std::size_t kNodesAtOnce = 256;

FloatBox
emptyBox()
{
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

FloatBox
boxOf(PointsView points, std::size_t begin, std::size_t end, const float* radii = nullptr)
{
  FloatBox box = emptyBox();
  const float* axes[3] = {points.x, points.y, points.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = begin; i < end; ++i) {
      const float radius = radii ? radii[i] : 0.0f;
      box.min[axis] = std::min(box.min[axis], axes[axis][i] - radius);
      box.max[axis] = std::max(box.max[axis], axes[axis][i] + radius);
    }
  return box;
}

/** The stretches of ones in a byte. */
struct BitSegments {
  std::uint8_t count = 0;
  std::uint8_t begin[4] = {}, end[4] = {};
};

constexpr std::array<BitSegments, 256>
makeBitSegments()
{
  std::array<BitSegments, 256> table{};
  for (unsigned byte = 0; byte < 256; ++byte)
    for (unsigned bit = 0; bit < 8; ++bit) {
      BitSegments& segments = table[byte];
      const bool set = (byte >> bit & 1u) != 0, set_before = bit > 0 && (byte >> (bit - 1) & 1u) != 0;
      if (set && !set_before)
        segments.begin[segments.count++] = static_cast<std::uint8_t>(bit);
      if (set)
        segments.end[segments.count - 1] = static_cast<std::uint8_t>(bit + 1);
    }
  return table;
}

constexpr std::array<BitSegments, 256> kBitSegments = makeBitSegments();

/** near[k]: which of the 8 boxes of packs[nodes[k]] come within `radius` of `box`, a bit each. */
void
findNear(const std::vector<BoxPack>& packs, const std::uint32_t* nodes, std::size_t count, const FloatBox& box, float radius,
         std::uint8_t* near)
{
  // Boxes that are not there are at infinity, beyond any finite square.
  const float radius_sq = std::min(radius * radius, std::numeric_limits<float>::max());
  kernels::active().near_children({packs.data(), nodes, count, box, radius_sq, near});
}

} // namespace

void
ClusterTree::fit(PointsView sorted, std::size_t threads, const float* radii)
{
  size_ = sorted.size;
  const auto packsFor = [](std::size_t children) { return (children + kFanout - 1) / kFanout; };
  std::size_t children = (size_ + kClusterSize - 1) / kClusterSize;
  std::size_t level_count = 0;
  do {
    if (levels_.size() <= level_count)
      levels_.emplace_back();
    levels_[level_count].resize(packsFor(children));
    children = packsFor(children);
    ++level_count;
  } while (children > 1);
  levels_.resize(level_count);

  for (std::size_t level = 0; level < level_count; ++level) {
    Level& packs = levels_[level];
    parallelBlocks(packs.size(), kPacksPerTask, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
        for (std::size_t c = 0; c < kFanout; ++c) {
          const std::size_t child = p * kFanout + c;
          FloatBox box = emptyBox();
          if (level == 0)
            box = boxOf(sorted, std::min(size_, child * kClusterSize), std::min(size_, (child + 1) * kClusterSize), radii);
          else if (child < levels_[level - 1].size())
            for (std::size_t axis = 0; axis < 3; ++axis) {
              const BoxPack& below = levels_[level - 1][child];
              box.min[axis] = *std::min_element(below.min[axis], below.min[axis] + kFanout);
              box.max[axis] = *std::max_element(below.max[axis], below.max[axis] + kFanout);
            }
          for (std::size_t axis = 0; axis < 3; ++axis) {
            packs[p].min[axis][c] = box.min[axis];
            packs[p].max[axis][c] = box.max[axis];
          }
        }
    });
  }
}

FloatBox
ClusterTree::bounds() const
{
  FloatBox box = emptyBox();
  if (size_ > 0)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const BoxPack& top = levels_.back().front();
      box.min[axis] = *std::min_element(top.min[axis], top.min[axis] + kFanout);
      box.max[axis] = *std::max_element(top.max[axis], top.max[axis] + kFanout);
    }
  return box;
}

void
ClusterTree::collectGroups(const FloatBox& box, float radius, std::vector<std::uint32_t>& groups) const
{
  groups.clear();
  if (size_ == 0)
    return;
  groups.push_back(0);
  std::vector<std::uint32_t> children;
  std::vector<std::uint8_t> near;
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    near.resize(groups.size());
    findNear(levels_[level], groups.data(), groups.size(), box, radius, near.data());
    children.clear();
    for (std::size_t k = 0; k < groups.size(); ++k)
      for (std::uint32_t c = 0; c < kFanout; ++c)
        if ((near[k] >> c & 1u) != 0)
          children.push_back(groups[k] * static_cast<std::uint32_t>(kFanout) + c);
    groups.swap(children);
  }
}

void
ClusterTree::collectRuns(const std::vector<std::uint32_t>& groups, const FloatBox& box, float radius, std::vector<Run>& runs) const
{
  std::uint8_t near[kNodesAtOnce]; // not allocated: the search of few boxes is short
  for (std::size_t first = 0; first < groups.size(); first += kNodesAtOnce) {
    const std::size_t count = std::min(groups.size() - first, kNodesAtOnce);
    findNear(levels_.front(), groups.data() + first, count, box, radius, near);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t group = groups[first + k];
      const BitSegments& segments = kBitSegments[near[k]];
      for (std::size_t s = 0; s < segments.count; ++s) {
        const auto begin = static_cast<std::uint32_t>((group * kFanout + segments.begin[s]) * kClusterSize);
        const auto end = static_cast<std::uint32_t>(std::min(size_, (group * kFanout + segments.end[s]) * kClusterSize));
        if (!runs.empty() && runs.back().end == begin)
          runs.back().end = end;
        else
          runs.push_back({begin, end});
      }
    }
  }
}

void
ClusterTree::collectRuns(const FloatBox& box, float radius, std::vector<Run>& runs) const
{
  if (size_ == 0)
    return;
  std::vector<std::uint32_t> groups;
  collectGroups(box, radius, groups);
  collectRuns(groups, box, radius, runs);
}

} // namespace pcl_gpf
