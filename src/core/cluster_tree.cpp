// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr unsigned kBitsPerAxis = 21; // three axes fill a 63-bit key
constexpr std::size_t kPointsPerTask = 16384;
constexpr std::size_t kPacksPerTask = 512;

/** Index along the Hilbert curve of a cell (Skilling, "Programming the Hilbert curve", 2004). */
std::uint64_t
hilbertKey(std::array<std::uint32_t, 3> cell)
{
  for (std::uint32_t bit = 1u << (kBitsPerAxis - 1); bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Branch-free: invert the low bits of x when this axis' bit is set, else exchange them with this axis'.
      const std::uint32_t set = 0u - static_cast<std::uint32_t>((cell[axis] & bit) != 0);
      const std::uint32_t exchanged = (cell[0] ^ cell[axis]) & below & ~set;
      cell[0] ^= (below & set) | exchanged;
      cell[axis] ^= exchanged;
    }
  }
  cell[1] ^= cell[0];
  cell[2] ^= cell[1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1u << (kBitsPerAxis - 1); bit > 1; bit >>= 1)
    flip ^= (bit - 1) & (0u - static_cast<std::uint32_t>((cell[2] & bit) != 0));
  std::uint64_t key = 0;
  const auto spread = [](std::uint64_t v) { // two zero bits between neighbouring bits
    v = (v | v << 32) & 0x1f00000000ffffull;
    v = (v | v << 16) & 0x1f0000ff0000ffull;
    v = (v | v << 8) & 0x100f00f00f00f00full;
    v = (v | v << 4) & 0x10c30c30c30c30c3ull;
    return (v | v << 2) & 0x1249249249249249ull;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    key |= spread(cell[axis] ^ flip) << (2 - axis);
  return key;
}

/** Stable least-significant-digit radix sort of values by 63-bit keys; digits that all keys share are skipped. */
void
radixSort(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& values)
{
  constexpr unsigned kDigitBits = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;
  std::vector<std::uint64_t> other_keys(keys.size());
  std::vector<std::uint32_t> other_values(values.size());
  for (unsigned shift = 0; shift < 63; shift += kDigitBits) {
    std::array<std::size_t, kBuckets> start{};
    for (const std::uint64_t key : keys)
      ++start[(key >> shift) & (kBuckets - 1)];
    if (start[(keys.front() >> shift) & (kBuckets - 1)] == keys.size())
      continue;
    std::size_t sum = 0;
    for (std::size_t& bucket : start)
      sum += std::exchange(bucket, sum);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::size_t target = start[(keys[i] >> shift) & (kBuckets - 1)]++;
      other_keys[target] = keys[i];
      other_values[target] = values[i];
    }
    keys.swap(other_keys);
    values.swap(other_values);
  }
}

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

/** The box that the curve fills; points outside it share its border cells. */
BoundingBox
curveBox(PointsView points)
{
  const FloatBox all = boxOf(points, 0, points.size);
  BoundingBox box;
  box.add(all.min[0], all.min[1], all.min[2]);
  box.add(all.max[0], all.max[1], all.max[2]);
  const float* axes[3] = {points.x, points.y, points.z};
  return denseBox(box, points.size, [&](std::size_t i, std::size_t axis) { return static_cast<double>(axes[axis][i]); });
}

} // namespace

std::vector<std::uint32_t>
hilbertOrder(PointsView points, std::size_t threads)
{
  std::vector<std::uint32_t> order(points.size);
  if (points.size == 0)
    return order;
  const BoundingBox box = curveBox(points);
  const double extent = std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  constexpr double kLastCell = (1u << kBitsPerAxis) - 1;
  const double to_cell = extent > 0.0 ? kLastCell / extent : 0.0;

  std::vector<std::uint64_t> keys(points.size);
  parallelBlocks(points.size, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    const auto cell = [&](float p, std::size_t axis) {
      return static_cast<std::uint32_t>(std::clamp((p - box.min[axis]) * to_cell, 0.0, kLastCell));
    };
    for (std::size_t i = begin; i < end; ++i) {
      keys[i] = hilbertKey({cell(points.x[i], 0), cell(points.y[i], 1), cell(points.z[i], 2)});
      order[i] = static_cast<std::uint32_t>(i);
    }
  });
  radixSort(keys, order);
  return order;
}

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
              const Pack& below = levels_[level - 1][child];
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
      const Pack& top = levels_.back().front();
      box.min[axis] = *std::min_element(top.min[axis], top.min[axis] + kFanout);
      box.max[axis] = *std::max_element(top.max[axis], top.max[axis] + kFanout);
    }
  return box;
}

void
ClusterTree::collectRuns(const FloatBox& box, float radius, std::vector<Run>& runs) const
{
  if (size_ > 0)
    descend(levels_.size() - 1, 0, box, std::min(radius * radius, std::numeric_limits<float>::max()), runs); // empty boxes are at infinity
}

void
ClusterTree::descend(std::size_t level, std::size_t pack, const FloatBox& box, float radius_sq, std::vector<Run>& runs) const
{
  const Pack& children = levels_[level][pack];
  float gap_sq[kFanout] = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < kFanout; ++c) {
      const float gap = std::max(0.0f, std::max(children.min[axis][c] - box.max[axis], box.min[axis] - children.max[axis][c]));
      gap_sq[c] += gap * gap;
    }
  for (std::size_t c = 0; c < kFanout; ++c) {
    if (!(gap_sq[c] <= radius_sq))
      continue;
    const std::size_t child = pack * kFanout + c;
    if (level > 0) {
      descend(level - 1, child, box, radius_sq, runs);
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(child * kClusterSize);
    const auto end = static_cast<std::uint32_t>(std::min(size_, (child + 1) * kClusterSize));
    if (!runs.empty() && runs.back().end == begin)
      runs.back().end = end;
    else
      runs.push_back({begin, end});
  }
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
  using Entry = std::pair<float, std::uint32_t>;
  std::vector<Entry> best; // heap, farthest first
  struct Node {            // heap below, nearest box first; level 0 is a cluster
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
    if (best.size() == k && node.gap_sq >= best.front().first)
      break;
    if (node.level == 0) {
      const std::size_t end = std::min(size_, (node.index + std::size_t{1}) * kClusterSize);
      for (std::size_t i = node.index * kClusterSize; i < end; ++i) {
        const float dx = sorted.x[i] - query[0], dy = sorted.y[i] - query[1], dz = sorted.z[i] - query[2];
        const float distance_sq = dx * dx + dy * dy + dz * dz;
        if (best.size() == k) {
          if (distance_sq >= best.front().first)
            continue;
          std::pop_heap(best.begin(), best.end());
          best.pop_back();
        }
        best.emplace_back(distance_sq, static_cast<std::uint32_t>(i));
        std::push_heap(best.begin(), best.end());
      }
      continue;
    }
    const Pack& children = levels_[node.level - 1u][node.index];
    for (std::size_t c = 0; c < kFanout; ++c) {
      float gap_sq = 0.0f;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float gap = std::max(0.0f, std::max(children.min[axis][c] - query[axis], query[axis] - children.max[axis][c]));
        gap_sq += gap * gap;
      }
      if (gap_sq < std::numeric_limits<float>::infinity() && (best.size() < k || gap_sq < best.front().first)) {
        queue.push_back({gap_sq, static_cast<std::uint32_t>(node.index * kFanout + c), static_cast<std::uint8_t>(node.level - 1)});
        std::push_heap(queue.begin(), queue.end());
      }
    }
  }
  std::sort_heap(best.begin(), best.end());
  for (const Entry& entry : best) {
    distances_sq.push_back(entry.first);
    if (indices)
      indices->push_back(entry.second);
  }
}

} // namespace pcl_gpf
