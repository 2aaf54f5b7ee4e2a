// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "figures.h"
#include "measure.h"
#include "methods.h"
#include "options.h"

#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief One line of the table. */
struct Record {
  std::string model;
  std::size_t size = 0;
  NoiseSpec noise;
  std::string method;
  std::string setting; ///< of the best variant
  Figures figures;
};

/** \brief Runs every variant of a method on a cloud and keeps the one with the least mean error.
 * \param[out] best_result what it made, or null */
Record
runMethod(const NoisyCloud& cloud,
          const Method& method,
          const MeasureOptions& options,
          MethodResult* best_result = nullptr);

/** \brief Runs everything that the options name, cloud by cloud, and hands each record over as soon as it is there. */
std::vector<Record>
runExperiment(const Options& options, const std::function<void(const Record&)>& report);

} // namespace pcl_gpf::quality
