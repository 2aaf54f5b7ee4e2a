// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>

#include "kernels/kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/** The k nearest of the points seen so far, and some more until there are enough of these to be worth a partition. */
class NearestEntries {
public:
  using Entry = std::pair<float, std::uint32_t>; ///< squared distance and index

  explicit NearestEntries(std::size_t k) : k_(k), capacity_(k + std::max<std::size_t>(16, k / 2)) { entries_.reserve(capacity_); }

  /** No point at or beyond this squared distance is wanted. */
  float bound() const { return bound_; }
  void
  add(float distance_sq, std::uint32_t index)
  {
    if (!(distance_sq < bound_))
      return;
    entries_.emplace_back(distance_sq, index);
    if (entries_.size() == capacity_)
      prune();
  }
  const std::vector<Entry>&
  sorted()
  {
    if (entries_.size() > k_)
      prune();
    std::sort(entries_.begin(), entries_.end());
    return entries_;
  }

private:
  void
  prune()
  {
    std::nth_element(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(k_ - 1), entries_.end());
    entries_.resize(k_);
    bound_ = entries_.back().first;
  }

  std::size_t k_, capacity_;
  float bound_ = std::numeric_limits<float>::infinity();
  std::vector<Entry> entries_;
};

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

void
ClusterTree::nearest(PointsView sorted,
                     const std::array<float, 3>& query,
                     std::size_t k,
                     std::vector<float>& distances_sq,
                     std::vector<std::uint32_t>* indices) const
{
  distances_sq.clear();
  if (indices)
    indices->clear();
  k = std::min(k, size_);
  if (k == 0)
    return;
  NearestEntries best(k);
  struct Node { // heap, nearest box first; level 0 is a cluster
    float gap_sq;
    std::uint32_t index;
    std::uint8_t level;
    bool operator<(const Node& other) const { return gap_sq > other.gap_sq; }
  };
  std::vector<Node> queue{{0.0f, 0, static_cast<std::uint8_t>(levels_.size())}};
  while (!queue.empty()) {
    std::pop_heap(queue.begin(), queue.end());
    const Node node = queue.back();
    queue.pop_back();
    if (node.gap_sq >= best.bound())
      break;
    if (node.level == 0) {
      const std::size_t end = std::min(size_, (node.index + std::size_t{1}) * kClusterSize);
      for (std::size_t i = node.index * kClusterSize; i < end; ++i) {
        const float dx = sorted.x[i] - query[0], dy = sorted.y[i] - query[1], dz = sorted.z[i] - query[2];
        best.add(dx * dx + dy * dy + dz * dz, static_cast<std::uint32_t>(i));
      }
      continue;
    }
    const BoxPack& children = levels_[node.level - 1u][node.index];
    for (std::size_t c = 0; c < kFanout; ++c) {
      float gap_sq = 0.0f;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float gap = std::max(0.0f, std::max(children.min[axis][c] - query[axis], query[axis] - children.max[axis][c]));
        gap_sq += gap * gap;
      }
      if (gap_sq < best.bound()) {
        queue.push_back({gap_sq, static_cast<std::uint32_t>(node.index * kFanout + c), static_cast<std::uint8_t>(node.level - 1)});
        std::push_heap(queue.begin(), queue.end());
      }
    }
  }
  for (const NearestEntries::Entry& entry : best.sorted()) {
    distances_sq.push_back(entry.first);
    if (indices)
      indices->push_back(entry.second);
  }
}

} // namespace pcl_gpf
