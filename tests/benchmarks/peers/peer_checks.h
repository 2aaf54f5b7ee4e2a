// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer_methods.h"

#include <stdexcept>
#include <string>

namespace pcl_gpf::benchmark_peers {

inline void
require(bool holds, const std::string& what)
{
  if (!holds)
    throw std::invalid_argument(what);
}

/** \brief For a method that takes the `neighbors` nearest of each point. */
inline void
requireNeighbors(const PeerCloud& cloud, unsigned neighbors, unsigned least)
{
  require(neighbors >= least, "fewer than " + std::to_string(least) + " neighbours");
  require(cloud.size() >= neighbors, "the cloud has " + std::to_string(cloud.size()) + " points, fewer than the neighbours wanted");
}

inline void
requireThreads(unsigned threads)
{
  require(threads >= 1, "the number of threads must be at least 1");
}

} // namespace pcl_gpf::benchmark_peers
