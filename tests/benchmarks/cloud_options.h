// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models.h"
#include "option_values.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Options that the benchmarks on synthetic clouds have in common, and the loop over a command line.
 */
namespace pcl_gpf::benchmark_options {

struct CloudOptions {
  std::vector<std::size_t> sizes;
  unsigned threads = 0;
  unsigned repeat = 5;
  std::string model = "block";
  double noise = 1.0;     ///< percent of the box diagonal
  double neighbors = 0.0; ///< points that every ball holds
};

/** \brief Sets one of the options above. \param[in] least_size smallest cloud \return whether `name` is one of them */
inline bool
setCloudValue(CloudOptions& o, const std::string& name, const std::string& value, std::size_t least_size)
{
  if (name == "--sizes")
    o.sizes = sizes(value, least_size);
  else if (name == "--threads")
    o.threads = number<unsigned>(value);
  else if (name == "--repeat")
    o.repeat = std::max(1u, number<unsigned>(value));
  else if (name == "--model") {
    benchmark_models::makeModel(value, 0, 0.0); // refuses unknown names
    o.model = value;
  } else if (name == "--noise")
    o.noise = number<double>(value);
  else if (name == "--neighbors")
    o.neighbors = number<double>(value);
  else
    return false;
  return true;
}

/** \brief Passes a command line on. \param[in] set_flag (name) -> whether it is an option without a value
 * \param[in] set_value (name, value) \throws std::invalid_argument if the last option lacks its value */
template <typename SetFlag, typename SetValue>
void
forEachOption(int argc, char** argv, const SetFlag& set_flag, const SetValue& set_value)
{
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (set_flag(name))
      continue;
    if (i + 1 == argc)
      throw std::invalid_argument(name + " is unknown or lacks its value");
    set_value(name, std::string(argv[++i]));
  }
}

} // namespace pcl_gpf::benchmark_options
