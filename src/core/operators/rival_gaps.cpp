// SPDX-License-Identifier: BSD-3-Clause
#include "rival_gaps.h"

#include "../kernels/kernels.h"
#include "patches.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kGapsPerTask = 1024;
/** Gaps are looked at together while the box of their bases is at most this many of their clearances wide; those of one descent into
 * the tree while theirs is so many. */
constexpr float kWidestBox = 4.0f, kWidestDescent = 24.0f;

/** The rivals' bases with the tree over them, in the order given. */
struct Rivals {
  SoaBuffer bases;
  AlignedArray<float> clearance_sq, priority;
  ClusterTree tree;

  Rivals(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& places, std::size_t threads)
  : bases(places.size()), clearance_sq(places.size()), priority(places.size())
  {
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Gap& gap = gaps[places[k]];
      bases.x[k] = gap.base[0];
      bases.y[k] = gap.base[1];
      bases.z[k] = gap.base[2];
      clearance_sq[k] = gap.clearance_sq;
      priority[k] = gap.priority;
    }
    tree.fit(view(), threads);
  }
  PointsView view() const { return bases.view(); }
};

/** Rows of better gaps, one task's after another's. */
struct BetterLists {
  std::vector<std::vector<std::uint32_t>> of_task; ///< members of all rows of a task
  std::vector<std::uint32_t> row_end;              ///< of each gap, in the array of its task

  BetterLists(const Rivals& rivals, std::size_t threads)
  : of_task((rivals.view().size + kGapsPerTask - 1) / kGapsPerTask), row_end(rivals.view().size)
  {
    const PointsView bases = rivals.view();
    const auto position = [&](std::size_t k) { return std::array<float, 3>{bases.x[k], bases.y[k], bases.z[k]}; };
    parallelBlocks(bases.size, kGapsPerTask, threads, [&](std::size_t begin, std::size_t end) {
      const float* clearances = rivals.clearance_sq.data();
      const auto widest = [clearances](std::size_t first, std::size_t last) {
        return std::sqrt(*std::max_element(clearances + first, clearances + last));
      };
      Rows rows;
      std::vector<std::uint32_t> groups;
      const float unit = widest(begin, end);
      forPatches(begin, end, kWidestDescent * unit, position, [&](std::size_t wide_first, std::size_t wide_last, const FloatBox& wide_box) {
        rivals.tree.collectGroups(wide_box, unit, groups);
        forPatches(wide_first, wide_last, kWidestBox * unit, position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
          rows.candidates.clear();
          rivals.tree.collectRuns(groups, box, widest(first, last), rows.candidates);
          append(rivals, first, last, rows);
        });
      });
      of_task[begin / kGapsPerTask].assign(rows.better.data(), rows.better.data() + rows.size);
    });
  }

private:
  /** Of one task, with the memory that its patches share. */
  struct Rows {
    std::vector<Run> candidates;
    kernels::RivalScratch scratch;
    std::vector<std::uint32_t> better; ///< `size` members, and room behind them
    std::size_t size = 0;
  };

  void
  append(const Rivals& rivals, std::size_t first, std::size_t last, Rows& rows)
  {
    std::size_t count = 0;
    for (const Run run : rows.candidates)
      count += run.end - run.begin;
    rows.scratch.reserve(count);
    const std::size_t most = rows.size + count * (last - first) + kQueryBlock;
    if (rows.better.size() < most)
      rows.better.resize(2 * most);
    kernels::active().better_gaps({{rivals.bases.x.data(), rivals.bases.y.data(), rivals.bases.z.data()}, rivals.clearance_sq.data(),
                                   rivals.priority.data(), rows.candidates.data(), rows.candidates.size(), first, last, &rows.scratch,
                                   rows.better.data() + rows.size, row_end.data() + first});
    for (std::size_t k = first; k < last; ++k)
      row_end[k] += static_cast<std::uint32_t>(rows.size);
    rows.size = row_end[last - 1];
  }
};

enum class State : std::uint8_t { Open, Taken, Left };

/** Decides the gaps of which all better ones within the clearance are decided, again and again; each time at least the best. */
std::vector<State>
decide(const BetterLists& lists, std::size_t count)
{
  std::vector<State> states(count, State::Open);
  std::vector<std::uint32_t> open(count);
  for (std::size_t k = 0; k < count; ++k)
    open[k] = static_cast<std::uint32_t>(k);
  while (!open.empty()) {
    std::size_t still_open = 0;
    for (const std::uint32_t k : open) {
      const std::vector<std::uint32_t>& members = lists.of_task[k / kGapsPerTask];
      State state = State::Taken;
      for (std::uint32_t m = k % kGapsPerTask == 0 ? 0 : lists.row_end[k - 1]; m < lists.row_end[k] && state != State::Left; ++m) {
        const State better = states[members[m]];
        if (better != State::Left)
          state = better == State::Taken ? State::Left : State::Open;
      }
      states[k] = state;
      open[still_open] = k;
      still_open += state == State::Open;
    }
    open.resize(still_open);
  }
  return states;
}

} // namespace

std::vector<std::uint32_t>
fillableTogether(const std::vector<Gap>& gaps, const std::vector<std::uint32_t>& rivals, std::size_t threads)
{
  const Rivals all(gaps, rivals, threads);
  const std::vector<State> states = decide(BetterLists(all, threads), rivals.size());
  std::vector<std::uint32_t> taken;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (states[k] == State::Taken)
      taken.push_back(rivals[k]);
  return taken;
}

} // namespace pcl_gpf
