// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"
#include "options.h"

#include <pcl_gpf/pipeline/mesh.h>

#include <array>
#include <optional>
#include <vector>

namespace pcl_gpf {

/** \brief The options that set MeshParameters; defaults and ranges are those of the library's structs. */
std::vector<OptionSpec>
meshOptions();

/** \brief Refuses options that the chosen method does not have. \throws UsageError */
void
checkMeshOptions(const Options& options);

/** \brief The parameters chosen; measures the cloud when a length is given in spacings or diagonals. */
MeshParameters
readMeshParameters(const Options& options, const LoadedCloud& cloud);

/** \brief The viewpoint of a file, unless it is the origin, which means none. */
std::optional<std::array<double, 3>>
viewpointOf(const CloudFile& file);

} // namespace pcl_gpf
