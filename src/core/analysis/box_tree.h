// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Balanced tree of axis-parallel boxes over points or triangles, for exact nearest-neighbour queries in double.
 *
 * Every node halves its items by count along its longest side, so the depth is log2(N / leaf) for any input, also for
 * coincident items. Build O(N log N).
 */
class BoxTree {
public:
  struct Box {
    Position min;
    Position max;
  };

  BoxTree() = default;
  /** \brief \param[in] items at least one, at most 2^32 - 1 \param[in] leaf_size most items of a leaf, >= 1 */
  BoxTree(const std::vector<Box>& items, std::uint32_t leaf_size);

  /** \brief Items in the order of the leaves: visit() is called with positions in this array. */
  const std::vector<std::uint32_t>& order() const { return order_; }

  /** \brief Visits items near `query`, nearest boxes first: visit(position, best_sq) may lower best_sq, the squared distance beyond
   * which boxes are skipped. Order and result depend on the tree only. */
  template <class Visit>
  void
  nearest(const Position& query, double& best_sq, Visit&& visit) const;

private:
  struct Node {
    Box box;
    std::uint32_t begin; ///< leaf: first position in order_; inner node: index of the right child (the left one is next)
    std::uint32_t count; ///< items of a leaf, 0 for an inner node
  };

  void
  build(const std::vector<Box>& items, std::uint32_t begin, std::uint32_t end, std::uint32_t leaf_size);

  static double
  squaredDistance(const Position& query, const Box& box)
  {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double outside = std::max({box.min[axis] - query[axis], query[axis] - box.max[axis], 0.0});
      sum += outside * outside;
    }
    return sum;
  }

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

template <class Visit>
void
BoxTree::nearest(const Position& query, double& best_sq, Visit&& visit) const
{
  struct Pending {
    std::uint32_t node;
    double distance_sq;
  };
  Pending stack[64]; // one entry a level; 32 levels hold 2^32 items
  std::size_t size = 0;
  stack[size++] = {0, squaredDistance(query, nodes_[0].box)};
  while (size > 0) {
    const Pending top = stack[--size];
    if (top.distance_sq >= best_sq)
      continue;
    const Node& node = nodes_[top.node];
    if (node.count > 0) {
      for (std::uint32_t position = node.begin; position < node.begin + node.count; ++position)
        visit(position, best_sq);
      continue;
    }
    Pending near{top.node + 1, squaredDistance(query, nodes_[top.node + 1].box)};
    Pending far{node.begin, squaredDistance(query, nodes_[node.begin].box)};
    if (far.distance_sq < near.distance_sq)
      std::swap(near, far);
    if (far.distance_sq < best_sq)
      stack[size++] = far;
    stack[size++] = near;
  }
}

} // namespace pcl_gpf
