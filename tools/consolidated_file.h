// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/io/cloud_file.h>
#include <pcl_gpf/pipeline/consolidate.h>

namespace pcl_gpf {

/** \brief Points of the chain as a file: position and normal of the cloud, all other fields of the row that each point comes from.
 * Integer coordinates become double. */
CloudFile
consolidatedFile(const CloudFile& source, const ConsolidatedCloud& cloud);

} // namespace pcl_gpf
