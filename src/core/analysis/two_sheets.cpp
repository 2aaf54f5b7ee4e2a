// SPDX-License-Identifier: BSD-3-Clause
#include "two_sheets.h"
#include "pooled_heights.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kStep = 2;
constexpr double kFlatter = 2.45;       ///< kurtosis of normal noise, trimmed at kPatchTrim ...
constexpr double kPooledFlatter = 2.88; ///< ... and at kPooledHeight, a little less
/** Every so many centres tell whether it is worth while: whether there are enough points, and not a kurtosis well above. */
constexpr std::size_t kFirstStep = 10;
constexpr double kFirstMargin = 0.08;
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

struct Pool {
  HeightCounts counts{};
  double heights = 0.0, squares = 0.0, fourth_powers = 0.0;
  double patches = 0.0;

  double
  perPatch() const
  {
    return patches > 0.0 ? heights / patches : 0.0;
  }
  double
  kurtosis() const
  {
    return squares > 0.0 ? heights * fourth_powers / (squares * squares) : 0.0;
  }
};

Pool
pool(const std::vector<PatchHeights>& patches)
{
  const double most = mostDeviation(patches);
  Pool pooled;
  for (const PatchHeights& p : patches) {
    if (!(p.patch.count > 0 && p.patch.deviation <= most))
      continue;
    ++pooled.patches;
    pooled.heights += static_cast<double>(p.heights.size());
    for (const float height : p.heights) {
      const double square = static_cast<double>(height) * height;
      pooled.squares += square;
      pooled.fourth_powers += square * square;
      ++pooled.counts[std::min(kHeightBins - 1, static_cast<std::size_t>(std::sqrt(square) * (kHeightBins / kPooledHeight)))];
    }
  }
  return pooled;
}

} // namespace

double
noiseOfOneSheet(const NoiseProbes& probes, const NoiseProbes::Centers& centers, double noise, double kurtosis)
{
  if (!(kurtosis < kFlatter) || !(noise > 0.0))
    return noise;
  const Pool first = pool(probes.heightsOfEach(centers, noise, kFirstStep));
  if (!(first.perPatch() >= 0.9 * kFewestPerPatch) || !(first.kurtosis() <= kPooledFlatter + kFirstMargin))
    return noise;
  const std::vector<PatchHeights> patches = probes.heightsOfEach(centers, noise, kStep);
  const Pool pooled = pool(patches);
  if (!(pooled.patches >= kLeastPart * static_cast<double>(patches.size())) || !(pooled.perPatch() >= kFewestPerPatch) ||
      !(pooled.kurtosis() <= kPooledFlatter))
    return noise;
  const SheetsFit fit = fitSheets(pooled.counts, pooled.perPatch());
  const bool two = fit.gain >= kLeastGain && fit.gain * pooled.heights >= kLeastEvidence && fit.share >= kLeastShare;
  return two ? noise * fit.deviation : noise;
}

} // namespace pcl_gpf
