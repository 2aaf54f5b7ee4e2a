// SPDX-License-Identifier: BSD-3-Clause
#include "two_sheets.h"
#include "pooled_heights.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kStep = 2;
constexpr double kFlatter = 2.45; ///< kurtosis of normal noise, trimmed
/** Patches that deviate by more than so many lowest tenths hold an edge. */
constexpr double kMostDeviation = 1.15;
/** Of fewer points a patch follows the noise too closely. */
constexpr double kFewestPerPatch = 100.0;
constexpr double kLeastPart = 0.5; ///< of the patches, to speak for the cloud
/** Of the likelihood's logarithm, for each height and in all: even noise in all directions reaches 20, two sheets 30 to 1,000. */
constexpr double kLeastGain = 5e-4, kLeastEvidence = 25.0;
constexpr double kLeastShare = 0.29; ///< of the variance: less is within a fifth anyway

/** Deviation up to which patches are pooled. \return 0 if there are too few */
double
mostDeviation(const std::vector<PatchHeights>& patches)
{
  std::vector<double> deviations;
  for (const PatchHeights& p : patches)
    if (p.patch.count > 0 && std::isfinite(p.patch.deviation))
      deviations.push_back(p.patch.deviation);
  if (2 * deviations.size() < patches.size())
    return 0.0;
  const auto tenth = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 10);
  std::nth_element(deviations.begin(), tenth, deviations.end());
  return kMostDeviation * *tenth;
}

} // namespace

double
noiseOfOneSheet(const NoiseProbes& probes, const NoiseProbes::Centers& centers, double noise, double kurtosis)
{
  if (!(kurtosis < kFlatter) || !(noise > 0.0))
    return noise;
  const std::vector<PatchHeights> patches = probes.heightsOfEach(centers, noise, kStep);
  const double most = mostDeviation(patches);
  HeightCounts counts{};
  double heights = 0.0, pooled = 0.0;
  for (const PatchHeights& p : patches) {
    if (!(p.patch.count > 0 && p.patch.deviation <= most))
      continue;
    ++pooled;
    heights += static_cast<double>(p.heights.size());
    for (const float height : p.heights)
      ++counts[std::min(kHeightBins - 1, static_cast<std::size_t>(std::abs(height) * (kHeightBins / kPooledHeight)))];
  }
  if (!(pooled >= kLeastPart * static_cast<double>(patches.size())) || !(heights >= kFewestPerPatch * pooled))
    return noise;
  const SheetsFit fit = fitSheets(counts, heights / pooled);
  const bool two = fit.gain >= kLeastGain && fit.gain * heights >= kLeastEvidence && fit.share >= kLeastShare;
  return two ? noise * fit.deviation : noise;
}

} // namespace pcl_gpf
