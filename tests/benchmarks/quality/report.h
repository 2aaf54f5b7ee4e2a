// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Heading of the table. */
std::string
tableHeading();
/** \brief A record as a line of the table; figures that do not apply are "-". */
std::string
tableLine(const Record& record);

std::string
csvHeading();
/** \brief A record as a line of CSV; figures that do not apply are empty. */
std::string
csvLine(const Record& record);
/** \brief The records of a file that this program wrote. \throws std::runtime_error when it is not one */
std::vector<Record>
readCsv(const std::string& path);

} // namespace pcl_gpf::quality
