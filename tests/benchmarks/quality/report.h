// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <cstdio>
#include <string>

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

} // namespace pcl_gpf::quality
