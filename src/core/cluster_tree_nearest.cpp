// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl_gpf {

namespace {

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

} // namespace

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
