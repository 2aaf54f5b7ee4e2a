// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_layout.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

// One writer per family of formats. The cloud is valid and fits (checkFits).
void writePcd(const CloudFile& cloud, CloudFormat format, const ByteSink& sink);
void writePly(const CloudFile& cloud, CloudFormat format, const ByteSink& sink);
void writeXyz(const CloudFile& cloud, const ByteSink& sink);

} // namespace pcl_gpf
