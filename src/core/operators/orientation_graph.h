// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Votes are kept as whole numbers, which halves their memory: this much is certainty. */
constexpr int kFullVote = 1024;

/** Rows of votes: that of i says which sign each of its neighbours has relative to i (positive: the same). */
struct VoteRows {
  std::vector<std::size_t> offsets; ///< rows + 1
  std::vector<std::uint32_t> neighbors;
  std::vector<std::int16_t> votes;

  std::size_t size() const { return offsets.size() - 1; }
};

/** The k nearest neighbours of every point and the radius that they fill. */
struct VoteGraph {
  VoteRows rows;
  std::vector<float> radius_sq;
};

/** Standard deviation of the positions along the normals as the k nearest neighbours see it: at most about half their
 * radius. */
double
noiseAlongNormals(const PointIndex& points, NormalsView normals, std::size_t k, std::size_t threads);

/** Votes of the k nearest neighbours. */
VoteGraph
neighborVotes(const PointIndex& points, NormalsView normals, std::size_t k, double noise, std::size_t threads);

/** Votes across gaps: of each point with the nearest one of another part within `gap` local spacings; rows may be
 * empty.
 * \param[in] part of each point */
VoteRows
gapVotes(const PointIndex& points, NormalsView normals, const std::vector<float>& radius_sq, std::size_t k,
         const std::vector<std::uint32_t>& part, double gap, double noise, std::size_t threads);

} // namespace pcl_gpf
