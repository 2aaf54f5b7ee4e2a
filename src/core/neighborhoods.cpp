// SPDX-License-Identifier: BSD-3-Clause
#include "neighborhoods.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pcl_gpf {

namespace {

constexpr std::size_t kBlocksPerTask = 256;
constexpr std::size_t kTasksPerThread = 2;
/** Room for runs, as a share of what a sample of blocks makes one expect. */
constexpr double kExpectedShare = 1.25;
/** Blocks that share one descent into the tree: together not much wider than a ball. */
constexpr std::size_t kBlocksPerDescent = 16;
/** Work beyond this many candidate pairs an iteration, and this many a point, is taken for a mistaken radius. */
constexpr double kMostCandidatePairs = 2e10;
constexpr double kManyCandidates = 20000.0;
/** Blocks that are counted before. */
constexpr std::size_t kProbes = 64;
/** Rough cost of a candidate pair on one thread, only used to put a figure into the refusal. */
constexpr double kSecondsPerCandidate = 1e-9;

FloatBox
blockBox(PointsView queries, std::size_t block)
{
  const std::size_t begin = block * kQueryBlock;
  const std::size_t end = std::min(queries.size, begin + kQueryBlock);
  FloatBox box;
  const float* axes[3] = {queries.x, queries.y, queries.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto range = std::minmax_element(axes[axis] + begin, axes[axis] + end);
    box.min[axis] = *range.first;
    box.max[axis] = *range.second;
  }
  return box;
}

FloatBox
unite(const FloatBox* boxes, std::size_t count)
{
  FloatBox all = boxes[0];
  for (std::size_t k = 1; k < count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.min[axis] = std::min(all.min[axis], boxes[k].min[axis]);
      all.max[axis] = std::max(all.max[axis], boxes[k].max[axis]);
    }
  return all;
}

/** A hair more than the radius: boxes are rounded to float, kernels may work in double. */
float
reach(double radius, const FloatBox& box)
{
  double farthest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = std::max(
        {farthest, std::abs(static_cast<double>(box.min[axis])), std::abs(static_cast<double>(box.max[axis]))});
  return static_cast<float>(radius * (1.0 + 1e-5) + 2e-7 * (farthest + radius));
}

std::string
rounded(double value)
{
  return std::to_string(static_cast<long long>(std::ceil(value)));
}

template <typename RadiusOfBlock>
CandidateCount
countCandidates(const ClusterTree& tree, PointsView queries, const RadiusOfBlock& radius)
{
  const std::size_t blocks = (queries.size + kQueryBlock - 1) / kQueryBlock;
  const std::size_t stride = (blocks + kProbes - 1) / kProbes;
  CandidateCount count;
  double probes = 0.0;
  std::vector<Run> runs;
  for (std::size_t block = 0; block < blocks; block += stride) {
    runs.clear();
    const FloatBox box = blockBox(queries, block);
    tree.collectRuns(box, reach(radius(block), box), runs);
    for (const Run& run : runs)
      count.data += static_cast<double>(run.end - run.begin);
    count.runs += static_cast<double>(runs.size());
    probes += 1.0;
  }
  if (probes > 0.0)
    count = {count.data / probes, count.runs / probes};
  return count;
}

/** The last defence of operators whose radii are not known before they start. \throws ExcessiveWork */
void
refuseExcessiveWork(const CandidateCount& count, PointsView queries)
{
  const double pairs = count.data * static_cast<double>(queries.size);
  if (!(count.data > kManyCandidates && pairs > kMostCandidatePairs))
    return;
  const double bytes = (count.runs * sizeof(Run) + sizeof(std::size_t)) * static_cast<double>(queries.size) /
                       static_cast<double>(kQueryBlock);
  throw ExcessiveWork("the radius holds about " + rounded(count.data) + " candidates a point, " + rounded(pairs / 1e9) +
                      " billion pairs: roughly " + rounded(pairs * kSecondsPerCandidate) +
                      " s an iteration on one thread and " + rounded(bytes / 1e6) +
                      " MB of lists; choose a smaller radius");
}

template <typename RadiusOfBlock>
Neighborhoods
collect(const ClusterTree& tree, PointsView queries, std::size_t threads, const RadiusOfBlock& radius)
{
  const CandidateCount expected = countCandidates(tree, queries, radius);
  refuseExcessiveWork(expected, queries);
  const std::size_t blocks = (queries.size + kQueryBlock - 1) / kQueryBlock;
  Neighborhoods result;
  result.query_count = queries.size;
  result.absent = tree.size();
  result.run_offsets.assign(blocks + 1, 0);
  result.runs.reserve(static_cast<std::size_t>(kExpectedShare * expected.runs * static_cast<double>(blocks)));
  // Of some tasks at a time: those of all would double the memory.
  std::vector<std::vector<Run>> runs(kTasksPerThread * threads);
  const auto collectTask = [&](std::size_t begin, std::size_t end, std::vector<Run>& own) {
    std::vector<Run> one;
    std::vector<std::uint32_t> groups;
    own.clear();
    for (std::size_t first = begin; first < end; first += kBlocksPerDescent) {
      const std::size_t last = std::min(end, first + kBlocksPerDescent);
      FloatBox boxes[kBlocksPerDescent];
      float reaches[kBlocksPerDescent], longest = 0.0f;
      for (std::size_t block = first; block < last; ++block) {
        boxes[block - first] = blockBox(queries, block);
        reaches[block - first] = reach(radius(block), boxes[block - first]);
        longest = std::max(longest, reaches[block - first]);
      }
      tree.collectGroups(unite(boxes, last - first), longest, groups);
      for (std::size_t block = first; block < last; ++block) {
        one.clear();
        tree.collectRuns(groups, boxes[block - first], reaches[block - first], one);
        own.insert(own.end(), one.begin(), one.end());
        result.run_offsets[block + 1] = one.size();
      }
    }
  };
  const std::size_t wave = runs.size() * kBlocksPerTask;
  for (std::size_t first = 0; first < blocks; first += wave) {
    const std::size_t count = std::min(wave, blocks - first);
    parallelBlocks(count, kBlocksPerTask, threads, [&](std::size_t begin, std::size_t end) {
      collectTask(first + begin, first + end, runs[begin / kBlocksPerTask]);
    });
    const std::size_t tasks = (count + kBlocksPerTask - 1) / kBlocksPerTask;
    std::size_t found = result.runs.size();
    for (std::size_t task = 0; task < tasks; ++task)
      found += runs[task].size();
    if (found > result.runs.capacity()) // by proportion; insert() would double it
      result.runs.reserve(found + static_cast<std::size_t>(kExpectedShare * static_cast<double>(found) *
                                                           static_cast<double>(blocks - first - count) /
                                                           static_cast<double>(first + count)));
    for (std::size_t task = 0; task < tasks; ++task)
      result.runs.insert(result.runs.end(), runs[task].begin(), runs[task].end());
  }
  for (std::size_t block = 0; block < blocks; ++block)
    result.run_offsets[block + 1] += result.run_offsets[block];
  return result;
}

/** \throws InvalidParameter */
void
checkLists(const NeighborLists& lists, std::size_t queries, std::size_t data)
{
  if (lists.offsets.size() != queries + 1 || lists.offsets.front() != 0 || lists.offsets.back() != lists.indices.size() ||
      !std::is_sorted(lists.offsets.begin(), lists.offsets.end()))
    throw InvalidParameter("the neighbour search does not give one row for each of the " + std::to_string(queries) + " queries");
  if (std::any_of(lists.indices.begin(), lists.indices.end(), [data](std::uint32_t index) { return index >= data; }))
    throw InvalidParameter("the neighbour search gives a neighbour that is none of the " + std::to_string(data) + " points");
}

} // namespace

CandidateCount
sampleCandidates(const ClusterTree& tree, PointsView queries, double radius)
{
  return countCandidates(tree, queries, [radius](std::size_t) { return radius; });
}

Neighborhoods
findNeighborhoods(const ClusterTree& tree, PointsView queries, double radius, std::size_t threads)
{
  return collect(tree, queries, threads, [radius](std::size_t) { return radius; });
}

Neighborhoods
findNeighborhoods(const ClusterTree& tree, PointsView queries, const float* radius_sq, std::size_t threads)
{
  return collect(tree, queries, threads, [&](std::size_t block) {
    const std::size_t begin = block * kQueryBlock;
    const std::size_t end = std::min(queries.size, begin + kQueryBlock);
    return std::sqrt(static_cast<double>(*std::max_element(radius_sq + begin, radius_sq + end)));
  });
}

Neighborhoods
transposeLists(const NeighborLists& lists, std::size_t queries, std::size_t data)
{
  if (data > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw ExcessiveWork("a foreign neighbour search is limited to 2^31 - 1 points");
  checkLists(lists, queries, data);
  const std::size_t blocks = (queries + kQueryBlock - 1) / kQueryBlock;
  Neighborhoods result;
  result.query_count = queries;
  result.absent = data;
  result.lane_offsets.assign(blocks + 1, 0);
  const auto rowSize = [&](std::size_t q) { return lists.offsets[q + 1] - lists.offsets[q]; };
  for (std::size_t block = 0; block < blocks; ++block) {
    std::size_t longest = 0;
    for (std::size_t q = block * kQueryBlock; q < std::min(queries, (block + 1) * kQueryBlock); ++q)
      longest = std::max(longest, rowSize(q));
    result.lane_offsets[block + 1] = result.lane_offsets[block] + longest;
  }
  result.lanes.assign(result.lane_offsets.back() * kQueryBlock, static_cast<std::int32_t>(data));
  for (std::size_t q = 0; q < queries; ++q)
    for (std::size_t k = 0; k < rowSize(q); ++k)
      result.lanes[(result.lane_offsets[q / kQueryBlock] + k) * kQueryBlock + q % kQueryBlock] =
          static_cast<std::int32_t>(lists.indices[lists.offsets[q] + k]);
  return result;
}

NeighborLists
reverseLists(const NeighborLists& lists, std::size_t data_count)
{
  NeighborLists result;
  result.offsets.assign(data_count + 1, 0);
  result.indices.resize(lists.indices.size());
  for (const std::uint32_t datum : lists.indices)
    ++result.offsets[datum + 1];
  for (std::size_t d = 0; d < data_count; ++d)
    result.offsets[d + 1] += result.offsets[d];
  std::vector<std::size_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t q = 0; q + 1 < lists.offsets.size(); ++q)
    for (std::size_t k = lists.offsets[q]; k < lists.offsets[q + 1]; ++k)
      result.indices[next[lists.indices[k]]++] = static_cast<std::uint32_t>(q);
  return result;
}

} // namespace pcl_gpf
