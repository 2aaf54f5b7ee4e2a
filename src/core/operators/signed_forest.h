// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "orientation_graph.h"

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Every point's group, numbered from 0 in the order of their first points, and its sign relative to the group (+1 or
 * -1). */
struct SignedGroups {
  std::vector<std::uint32_t> group;
  std::vector<std::int8_t> sign;
  std::size_t count = 0;
};

/** Each point a group of its own. */
SignedGroups
singleGroups(std::size_t size);

/** Joins groups until no vote leads from one to another: in every round each group joins the neighbour with the
 * clearest sum of votes, and the votes of what has been joined are added up. */
void
joinGroups(const VoteRows& rows, SignedGroups& groups);

/** Lets every point follow the votes of its neighbours, in order, until none turns or `sweeps` are done. */
void
followMajority(const VoteRows& rows, SignedGroups& groups, unsigned sweeps);

} // namespace pcl_gpf
