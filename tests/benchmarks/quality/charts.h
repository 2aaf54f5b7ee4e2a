// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief A picture of records. */
struct Chart {
  std::string file_name; ///< quality_<model>.svg, with kind, size and outliers where they are not the usual ones
  std::string svg;
};

/** \brief Everything about a record's cloud but its noise level: model, and kind, size and outliers where they
 * are not the usual ones. */
std::string
seriesOf(const Record& record);
/** \brief The text with an underscore for everything but letters, digits, - and point. */
std::string
fileSafe(std::string text);

/** \brief A chart for each model, kind, size and share of outliers that was run with noise: mean error and, where there
 * are sharp edges, ecov over the noise, one line a method. */
std::vector<Chart>
drawCharts(const std::vector<Record>& records);

} // namespace pcl_gpf::quality
