// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peers_options.h"

#include "benchmarks/model_cloud.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_gpf::benchmark_peers {

/** \brief What a run gave besides its time. */
struct Outcome {
  std::size_t points = 0;
  std::vector<std::pair<std::string, double>> stages; ///< wall seconds of its parts, where it has parts
};

/** \brief A method with its parameters on one cloud. */
struct Contestant {
  std::string name;
  std::string parameters;
  std::function<Outcome()> run;
};

constexpr const char* kOurs = "ours";                ///< balls of as many neighbours as the peers'
constexpr const char* kOursDefault = "ours_default"; ///< estimated lengths

/** \brief The methods wanted, the two of ours always first. \param[in] cloud must outlive them
 * \throws std::invalid_argument for a name that does not exist */
std::vector<Contestant>
contestants(const PeersOptions& options, const benchmark_models::ModelCloud& cloud);

} // namespace pcl_gpf::benchmark_peers
