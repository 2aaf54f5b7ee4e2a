// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "filter_parameters.h"

#include <pcl_gpf/pipeline/consolidate.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What a run of the chain has to tell beside its result. */
struct ChainRun {
  std::string input, output;
  std::vector<std::string> intermediate; ///< files written on the way
  std::size_t input_points = 0;
  std::string normals; ///< "file" or "estimated"
  std::vector<EffectiveParameter> filter_parameters;
  bool colors = false;
  unsigned threads = 0;
  double seconds_read = 0.0, seconds_write = 0.0, seconds_total = 0.0;
};

/** \brief The report of --json. */
nlohmann::ordered_json
runReport(const ChainRun& run, const ConsolidationParameters& parameters, const ConsolidationResult& result,
          const std::vector<std::string>& warnings);

/** \brief What happened, a line a stage, for the terminal. */
std::string
runSummary(const ChainRun& run, const ConsolidationParameters& parameters, const ConsolidationResult& result);

} // namespace pcl_gpf
