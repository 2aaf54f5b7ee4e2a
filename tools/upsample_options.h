// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"
#include "options.h"

#include <pcl_gpf/pipeline/upsample.h>

#include <vector>

namespace pcl_gpf {

/** \brief The options of upsampling; defaults and ranges are those of the library's structs. */
std::vector<OptionSpec>
upsampleOptions();

/** \brief Refuses two targets, and options that the chosen method does not have. \throws UsageError */
void
checkUpsampleOptions(const Options& options);

/** \brief The parameters chosen, with the lengths of this cloud. \throws UsageError: a count below that of the cloud */
UpsampleParameters
readUpsampleParameters(const Options& options, const LoadedCloud& cloud);

} // namespace pcl_gpf
