// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/io/cloud_file.h>

#include <vector>

namespace pcl_gpf {

/** \brief Coordinates by point. */
std::vector<Position>
positionsOf(const CloudCoordinates& coordinates);

/** \brief The normals in the file by point, of any length; empty when it has none. */
std::vector<Position>
normalsOf(const CloudFile& cloud);

/** \brief Whether any normal in the file has a direction: many programs write fields of zeros. */
bool
hasUsableNormal(const CloudFile& cloud);

} // namespace pcl_gpf
