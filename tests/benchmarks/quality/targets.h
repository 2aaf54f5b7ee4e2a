// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief One figure that is asked for: `must` is the requirement, `aim` the wish. */
struct Target {
  std::string model;
  double percent; ///< Gaussian noise
  const char* name;
  double (*value)(const Figures&);
  double must, aim; ///< largest allowed; aim NaN = none
};

/** \brief All targets, those of one cloud in a row. */
std::vector<Target>
allTargets();

/** \brief A target with what was reached. */
struct TargetResult {
  Target target;
  double value = 0;

  bool
  holds() const
  {
    return value <= target.must;
  }
};

/** \brief Filters the clouds of the targets with the first of the methods that is not "input" and compares.
 * \param[in] report called after each cloud with its record */
std::vector<TargetResult>
runTargets(const Options& options, const std::function<void(const Record&)>& report);

/** \brief A table of the results with a verdict for each. */
std::string
targetTable(const std::vector<TargetResult>& results);

} // namespace pcl_gpf::quality
