// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noisy_cloud.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <functional>
#include <string>

namespace pcl_gpf::quality {

/** \brief Changes parameters before a cloud is filtered. */
using ParameterChange = std::function<void(DenoiseParameters&, const NoisyCloud&)>;

/** \brief The changes named in `text`, each "name" or "name=value", with + between; empty text changes nothing.
 * \throws std::invalid_argument */
ParameterChange
parseChanges(const std::string& text);

/** \brief One line for each change, for the usage text. */
std::string
describeChanges();

} // namespace pcl_gpf::quality
