// SPDX-License-Identifier: BSD-3-Clause
#include "compact_order.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPatch = 256; ///< larger ones gain little more
constexpr std::size_t kPatchesPerTask = 64;

struct Member {
  std::array<float, 3> position;
  std::uint32_t rank; ///< on the curve; decides between equal coordinates
};

std::size_t
longestAxis(const Member* begin, const Member* end)
{
  std::array<float, 3> low = begin->position, high = begin->position;
  for (const Member* m = begin + 1; m != end; ++m)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], m->position[axis]);
      high[axis] = std::max(high[axis], m->position[axis]);
    }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] > high[longest] - low[longest])
      longest = axis;
  return longest;
}

/** Up to this many members are sorted by counting, which has no branches to guess. */
constexpr std::size_t kFew = 16;

void
sortFew(Member* begin, std::size_t size, std::size_t axis)
{
  std::array<std::size_t, kFew> place{};
  for (std::size_t i = 1; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const float a = begin[i].position[axis], b = begin[j].position[axis];
      const bool before = (a < b) | ((a == b) & (begin[i].rank < begin[j].rank));
      place[j] += before;
      place[i] += !before;
    }
  std::array<Member, kFew> sorted;
  for (std::size_t k = 0; k < size; ++k)
    sorted[place[k]] = begin[k];
  std::copy(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(size), begin);
}

/** The left part is the largest power of two below the size, so that all cuts fall on multiples of the parts' sizes. Which points go
 * left does not depend on the standard library: no two members are equal. */
void
halve(Member* begin, Member* end)
{
  const std::size_t size = static_cast<std::size_t>(end - begin);
  if (size <= 2) {
    if (size == 2 && begin[1].rank < begin[0].rank)
      std::swap(begin[0], begin[1]);
    return;
  }
  std::size_t left = 2;
  while (2 * left < size)
    left *= 2;
  const std::size_t axis = longestAxis(begin, end);
  if (size <= kFew)
    sortFew(begin, size, axis);
  else
    std::nth_element(begin, begin + left, end, [axis](const Member& a, const Member& b) {
      return a.position[axis] < b.position[axis] || (a.position[axis] == b.position[axis] && a.rank < b.rank);
    });
  halve(begin, begin + left);
  halve(begin + left, end);
}

} // namespace

std::vector<std::uint32_t>
compactOrder(PointsView points, std::size_t threads)
{
  std::vector<std::uint32_t> order = hilbertOrder(points, threads);
  parallelBlocks(order.size(), kPatchesPerTask * kPatch, threads, [&](std::size_t task_begin, std::size_t task_end) {
    std::array<Member, kPatch> members;
    std::array<std::uint32_t, kPatch> before;
    for (std::size_t begin = task_begin; begin < task_end; begin += kPatch) {
      const std::size_t size = std::min(task_end - begin, kPatch);
      for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t i = before[k] = order[begin + k];
        members[k] = {{points.x[i], points.y[i], points.z[i]}, k};
      }
      halve(members.data(), members.data() + size);
      for (std::size_t k = 0; k < size; ++k)
        order[begin + k] = before[members[k].rank];
    }
  });
  return order;
}

} // namespace pcl_gpf
