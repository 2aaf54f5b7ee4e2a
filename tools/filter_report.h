// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apply_result.h"
#include "filter_parameters.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Everything that a run of the filter has to tell. */
struct FilterRun {
  std::string input, output;
  std::size_t input_points = 0;
  std::size_t input_finite = 0;
  std::string input_format, normals; ///< normals: "file" or "estimated"
  std::size_t points = 0; ///< written
  unsigned threads = 0;
  std::vector<EffectiveParameter> parameters;
  Movement movement;
  std::string outliers;           ///< keep, flag or drop
  std::size_t outlier_points = 0, dropped = 0;
  std::vector<std::string> fields; ///< extra fields written
  double seconds_read = 0.0, seconds_write = 0.0, seconds_total = 0.0;
};

/** \brief Value, origin and reason of each parameter under the name of its option. */
nlohmann::ordered_json
parametersJson(const std::vector<EffectiveParameter>& parameters);

/** \brief The report of --json. */
nlohmann::ordered_json
filterReport(const FilterRun& run, const DenoiseResult& result, const std::vector<std::string>& warnings);

/** \brief The parameters for the terminal: a line for each that is not a default, and one line with the defaults. */
std::string
parametersText(const std::vector<EffectiveParameter>& parameters);

/** \brief What happened, in a few lines for the terminal. */
std::string
summaryText(const FilterRun& run, const DenoiseResult& result);

} // namespace pcl_gpf
