// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Of `candidates` the one that `word` is most likely a misspelling of, or "" when none is near.
 *
 * Near: at most a third of the letters inserted, deleted, replaced or swapped with their neighbour; failing that, the beginning of
 * a candidate, of several the shortest. */
std::string
nearestSpelling(const std::string& word, const std::vector<std::string>& candidates);

} // namespace pcl_gpf
