// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/box_tree.h"

#include <numeric>

namespace pcl_gpf {
namespace {

double
centre(const BoxTree::Box& box, std::size_t axis)
{
  return 0.5 * box.min[axis] + 0.5 * box.max[axis];
}

std::size_t
longestAxis(const BoxTree::Box& box)
{
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (box.max[axis] - box.min[axis] > box.max[longest] - box.min[longest])
      longest = axis;
  return longest;
}

} // namespace

BoxTree::BoxTree(const std::vector<Box>& items, std::uint32_t leaf_size) : order_(items.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * items.size() / leaf_size + 2);
  build(items, 0, static_cast<std::uint32_t>(items.size()), leaf_size);
}

void
BoxTree::build(const std::vector<Box>& items, std::uint32_t begin, std::uint32_t end, std::uint32_t leaf_size)
{
  Box box = items[order_[begin]];
  for (std::uint32_t position = begin + 1; position < end; ++position)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], items[order_[position]].min[axis]);
      box.max[axis] = std::max(box.max[axis], items[order_[position]].max[axis]);
    }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box, begin, end - begin});
  if (end - begin <= leaf_size)
    return;

  const std::size_t axis = longestAxis(box);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double centre_a = centre(items[a], axis);
                     const double centre_b = centre(items[b], axis);
                     return centre_a < centre_b || (centre_a == centre_b && a < b);
                   });
  build(items, begin, middle, leaf_size);
  nodes_[self].count = 0;
  nodes_[self].begin = static_cast<std::uint32_t>(nodes_.size());
  build(items, middle, end, leaf_size);
}

} // namespace pcl_gpf
