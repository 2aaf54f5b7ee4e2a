// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/search_adapter.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace pcl_gpf {
namespace {

constexpr std::size_t kQueriesPerBlock = 512;

// Floats of the size of the box are off by up to 6e-8 of the diagonal, and PCL squares distances in float.
constexpr double kRelativeMargin = 1e-4;
constexpr double kRoundingMargin = 1e-6;

// Diagonals whose square and its reciprocal stay well inside the range of float.
constexpr double kSmallestDiagonal = 1e-15;
constexpr double kLargestDiagonal = 1e15;

struct RowBlock {
  std::vector<std::size_t> sizes;
  std::vector<std::uint32_t> indices;
};

NeighborLists
joinBlocks(const std::vector<RowBlock>& blocks, std::size_t queries)
{
  NeighborLists lists;
  lists.offsets.reserve(queries + 1);
  lists.offsets.push_back(0);
  for (const RowBlock& block : blocks)
    for (const std::size_t size : block.sizes)
      lists.offsets.push_back(lists.offsets.back() + size);
  lists.indices.reserve(lists.offsets.back());
  for (const RowBlock& block : blocks)
    lists.indices.insert(lists.indices.end(), block.indices.begin(), block.indices.end());
  return lists;
}

} // namespace

NeighborLists
collectRows(std::size_t queries, std::size_t threads, const RowSearch& search, std::size_t maximum_pairs)
{
  std::vector<RowBlock> blocks((queries + kQueriesPerBlock - 1) / kQueriesPerBlock);
  std::atomic<std::size_t> pairs{0};
  parallelBlocks(queries, kQueriesPerBlock, threads, [&](std::size_t begin, std::size_t end) {
    RowBlock& block = blocks[begin / kQueriesPerBlock];
    std::vector<std::uint32_t> row;
    for (std::size_t query = begin; query < end; ++query) {
      search(query, row);
      if ((pairs += row.size()) > maximum_pairs)
        throw ExcessiveWork("the neighbour search finds more than " + std::to_string(maximum_pairs) +
                            " pairs within the radius; reduce the radius or use the built-in search");
      std::sort(row.begin(), row.end());
      block.sizes.push_back(row.size());
      block.indices.insert(block.indices.end(), row.begin(), row.end());
    }
  });
  return joinBlocks(blocks, queries);
}

double
widenedRadius(const LocalFrame& frame, double radius)
{
  return frame.lengthToWorld(radius * (1 + kRelativeMargin) + kRoundingMargin);
}

void
checkSearchMethod(const std::string& search_name, const LocalFrame& frame)
{
  if (search_name == "OrganizedNeighbor")
    throw InvalidParameter("search method OrganizedNeighbor needs an organised cloud, which filtered points are not; "
                           "use pcl::search::KdTree, or no search method for the built-in one");
  if (!(frame.scale >= kSmallestDiagonal && frame.scale <= kLargestDiagonal))
    throw InvalidParameter("the cloud's box diagonal is " + std::to_string(frame.scale) +
                           ", whose square a PCL search cannot hold in float; "
                           "change the unit or use the built-in search");
}

} // namespace pcl_gpf
