// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiment.h"

#include <string>

namespace pcl_gpf::quality {

/** \brief Name of a record's cloud file: <model>_<noise>_<method>.ply, with kind, size and outliers
 * where they are not the usual ones. */
std::string
cloudFileName(const Record& record);

/** \brief Writes the finite points of a result as binary PLY, replacing an older file: position, normal where the
 * method gives one, and `distance`, the distance to the true surface in 1e-4 of its box diagonal. \throws IoError */
void
writeResultCloud(const std::string& path, const NoisyCloud& cloud, const MethodResult& result);

} // namespace pcl_gpf::quality
