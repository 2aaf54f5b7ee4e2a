// SPDX-License-Identifier: BSD-3-Clause
#include "peer_variants.h"

/** \file
 * \brief Stands in for peer_variants.cpp in a build without PCL_GPF_BENCHMARK_PEERS.
 */
namespace pcl_gpf::quality {

std::vector<Variant>
peerVariants(const std::string&)
{
  return {};
}

} // namespace pcl_gpf::quality
