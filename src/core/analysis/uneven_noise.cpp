// SPDX-License-Identifier: BSD-3-Clause
#include "uneven_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr std::size_t kAround = 5;
constexpr double kHighestLevel = 1.4; // medians; a patch that took in another part shows more

constexpr std::size_t kStep = 2;
constexpr double kMostTrimmed = 0.06;
/** At one guess patches differ less than they do, each settled at its own width. On even noise these reach 0.5 only with a spread below. */
constexpr double kHintOfCoherence = 0.25, kCoherent = 0.5, kMostCoherent = 0.65, kLeastSpread = 1.22;
/** Of the patches, to speak for the cloud; fewer do if they agree well. */
constexpr double kLeastPart = 0.55, kLeastCoherentPart = 0.25;
/** Levels that agree less still tell uneven noise if the heights in the loudest third are as normal as in the others: their kurtosis is
 * 2.45 on normal noise and 1.8 to 2.3 across edges and thin walls. The estimate then goes most of the way to the root mean square. */
constexpr double kLeastWeakSpread = 1.2, kWeakCoherence = 0.25, kWeakEvidence = 0.62;
constexpr double kLeastLoudKurtosis = 2.34, kKurtosisOfCoherence = 0.3; ///< the latter less for each unit of coherence above the weak

double
middleOf(std::vector<double>& values, double quantile)
{
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double
distanceSq(const NoiseLevel& a, const NoiseLevel& b)
{
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += (a.center[axis] - b.center[axis]) * (a.center[axis] - b.center[axis]);
  return sum;
}

/** Median logarithm of the levels nearest to one, of patches apart from it. \return NaN if there is none */
double
levelAround(const std::vector<NoiseLevel>& levels, const std::vector<double>& logarithms, std::size_t i)
{
  std::array<std::pair<double, double>, kAround> nearest; // squared distance, logarithm; by distance
  std::size_t count = 0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double distance_sq = distanceSq(levels[i], levels[k]), touching = levels[i].reach + levels[k].reach;
    if (!(distance_sq > touching * touching) || (count == kAround && !(distance_sq < nearest.back().first)))
      continue;
    std::size_t place = count < kAround ? count++ : kAround - 1;
    for (; place > 0 && nearest[place - 1].first > distance_sq; --place)
      nearest[place] = nearest[place - 1];
    nearest[place] = {distance_sq, logarithms[k]};
  }
  if (count == 0)
    return std::nan("");
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(nearest[k].second);
  return middleOf(values, 0.5);
}

double
correlation(const std::vector<std::pair<double, double>>& pairs)
{
  const auto count = static_cast<double>(pairs.size());
  double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (const auto& [x, y] : pairs) {
    a += x / count;
    b += y / count;
  }
  for (const auto& [x, y] : pairs) {
    aa += (x - a) * (x - a);
    bb += (y - b) * (y - b);
    ab += (x - a) * (y - b);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/** Of the loudest third of levels that are sorted. */
double
meanKurtosisOfLoudest(const std::vector<NoiseLevel>& levels)
{
  const std::size_t first = levels.size() - std::max<std::size_t>(1, levels.size() / 3);
  double sum = 0.0;
  for (std::size_t k = first; k < levels.size(); ++k)
    sum += levels[k].kurtosis;
  return sum / static_cast<double>(levels.size() - first);
}

/** How sure it is that the levels differ because the noise does, 0 to 1. `hint`: levels at one guess */
double
evidenceOfUnevenness(const LevelVariation& hint, const LevelVariation& settled, double part)
{
  if (!(settled.spread >= kLeastWeakSpread))
    return 0.0;
  const bool most_coherent = settled.coherence >= kMostCoherent && part >= kLeastCoherentPart;
  const bool coherent = settled.coherence >= kCoherent && part >= kLeastPart && settled.spread >= kLeastSpread;
  if (most_coherent || coherent)
    return std::min(1.0, kWeakEvidence + (1.0 - kWeakEvidence) * (settled.coherence - kCoherent) / (kMostCoherent - kCoherent));
  const double coherence = 0.5 * (hint.coherence + settled.coherence) - kWeakCoherence;
  const bool weak = coherence >= 0.0 && settled.loud_kurtosis >= kLeastLoudKurtosis - kKurtosisOfCoherence * coherence;
  return weak && part >= kLeastPart ? kWeakEvidence : 0.0;
}

} // namespace

LevelVariation
levelVariation(const std::vector<NoiseLevel>& all)
{
  std::vector<NoiseLevel> levels;
  std::vector<double> values;
  for (const NoiseLevel& level : all)
    if (std::isfinite(level.noise) && level.noise > 0.0) {
      levels.push_back(level);
      values.push_back(level.noise);
    }
  LevelVariation variation;
  variation.count = levels.size();
  if (levels.empty())
    return variation;
  std::sort(levels.begin(), levels.end(), [](const NoiseLevel& a, const NoiseLevel& b) {
    return a.noise < b.noise || (a.noise == b.noise && a.kurtosis < b.kurtosis);
  });
  variation.loud_kurtosis = meanKurtosisOfLoudest(levels);
  const double median = middleOf(values, 0.5);
  variation.spread = median / middleOf(values, 0.1);
  std::vector<double> logarithms;
  double squares = 0.0;
  for (const NoiseLevel& level : levels) {
    squares += std::pow(std::min(level.noise, kHighestLevel * median), 2);
    logarithms.push_back(std::log(level.noise));
  }
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double around = levelAround(levels, logarithms, i);
    if (std::isfinite(around))
      pairs.emplace_back(logarithms[i], around);
  }
  variation.rms = std::sqrt(squares / static_cast<double>(levels.size()));
  variation.coherence = correlation(pairs);
  return variation;
}

double
noiseOverAll(const NoiseProbes& probes, const NoiseProbes::Centers& centers, double guess, const std::vector<NoiseReading>& patches,
             double noise)
{
  std::vector<NoiseLevel> levels;
  for (std::size_t k = 0; k < patches.size(); ++k)
    levels.push_back({centers[k], patches[k].trimmed < kMostTrimmed ? patches[k].level : 0.0, patches[k].reach, patches[k].kurtosis});
  const LevelVariation hint = levelVariation(levels);
  if (!(hint.coherence >= kHintOfCoherence))
    return noise;
  levels = probes.settleEach(centers, patches, guess, kStep);
  const LevelVariation settled = levelVariation(levels);
  if (!(settled.rms > noise))
    return noise;
  const double part = static_cast<double>(settled.count) / static_cast<double>(levels.size());
  return noise * std::pow(settled.rms / noise, evidenceOfUnevenness(hint, settled, part));
}

} // namespace pcl_gpf
