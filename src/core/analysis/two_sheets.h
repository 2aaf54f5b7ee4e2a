// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise_probes.h"

namespace pcl_gpf {

/** \brief The noise of one sheet where most patches hold two that are too near to be told apart in any one of them: thousands of heights
 * of many patches together tell two humps from one (fitSheets()).
 *
 * \param[in] noise as of one sheet \param[in] kurtosis of trimmed heights; nothing is done unless it is below that of normal noise
 * \return `noise` where one sheet is as likely, or too few points tell
 */
double
noiseOfOneSheet(const NoiseProbes& probes, const NoiseProbes::Centers& centers, double noise, double kurtosis);

} // namespace pcl_gpf
