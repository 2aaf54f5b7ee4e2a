// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise_probes.h"

#include <vector>

namespace pcl_gpf {

/** \brief How levels of patches vary over the surface. */
struct LevelVariation {
  double coherence = 0.0; ///< correlation of the logarithm of a level with the median of those around it that share no point with it
  double spread = 1.0;    ///< median / lowest tenth
  double rms = 0.0;       ///< root mean square, levels cut off at kHighestLevel medians
  std::size_t count = 0;
  double loud_kurtosis = 0.0; ///< mean kurtosis of the loudest third
};

/** \brief Levels of 0 or that are not finite do not count. Cost: quadratic in the number of levels. */
LevelVariation
levelVariation(const std::vector<NoiseLevel>& levels);

/** \brief Root mean square over the surface where the noise varies smoothly along it; else `noise`, that of the quietest patches;
 * between them where less speaks for uneven noise.
 *
 * Patches with edges or details show more noise, too, but do not agree with others about them that share no point with them, and their
 * heights are flatter than noise. Most clouds are decided by `patches`, read at one `guess`; only if these agree does each settle at its
 * own width.
 */
double
noiseOverAll(const NoiseProbes& probes, const NoiseProbes::Centers& centers, double guess, const std::vector<NoiseReading>& patches,
             double noise);

} // namespace pcl_gpf
