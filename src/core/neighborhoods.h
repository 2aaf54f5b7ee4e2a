// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Queries are worked on in blocks of this many, the widest vector of any target. */
constexpr std::size_t kQueryBlock = 16;

/** \brief Candidates of every block of 16 consecutive queries: runs of sorted data points, or the lists of a foreign search.
 *
 * A superset of the pairs in reach: kernels test the distance. Built once and used again while points have moved little.
 */
struct Neighborhoods {
  std::size_t query_count = 0;
  std::vector<std::size_t> run_offsets;  ///< blocks + 1
  std::vector<Run> runs;
  std::size_t absent = 0;                ///< index of a padded datum, which is no neighbour of any query

  /** Foreign lists, transposed: entry (offset of block + k) * 16 + lane is the k-th candidate of that lane, `absent` when it has
   * fewer. Empty when runs are used. */
  std::vector<std::size_t> lane_offsets; ///< blocks + 1, in rows of 16
  AlignedArray<std::int32_t> lanes;

  bool foreign() const { return !lane_offsets.empty(); }
};

/** \brief Size of the candidate lists, means over a sample of blocks. */
struct CandidateCount {
  double data = 0; ///< a query
  double runs = 0; ///< a block
};
CandidateCount
sampleCandidates(const ClusterTree& tree, PointsView queries, double radius);

/** \brief Runs of `tree` within `radius` of each block of sorted `queries`. \throws ExcessiveWork */
Neighborhoods
findNeighborhoods(const ClusterTree& tree, PointsView queries, double radius, std::size_t threads);

/** \brief The same for a radius of each query. */
Neighborhoods
findNeighborhoods(const ClusterTree& tree, PointsView queries, const float* radius_sq, std::size_t threads);

/** \brief From rows of neighbours that a foreign search found. \param[in] data their number, which stands for no neighbour too (a padded
 * data point) \throws InvalidParameter where there are not as many rows as queries, or a neighbour is none of the data */
Neighborhoods
transposeLists(const NeighborLists& lists, std::size_t queries, std::size_t data);

/** \brief Rows of data -> queries turned into rows of queries -> data. */
NeighborLists
reverseLists(const NeighborLists& lists, std::size_t data_count);

} // namespace pcl_gpf
