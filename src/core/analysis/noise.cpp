// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/noise.h>

#include "noise_probes.h"
#include "two_sheets.h"
#include "uneven_noise.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

constexpr int kMostRounds = 24;
/** Trimmed heights above fitted patches: their kurtosis, and the least share of them that is trimmed, if noise is normal. Even noise is
 * flatter and ends before the trim, so that what deviations are corrected by is too much, by so much for each unit of kurtosis. */
constexpr double kNormalKurtosis = 2.45;
constexpr double kNormalTrimmed = 0.017;
constexpr double kEvenExcess = 0.25;
constexpr double kMostExcess = 0.12;

/** One step towards the noise at which patches as wide as it asks for show just that noise. Deviations follow the guess at about half
 * its rate there, so the step is made half as long again. */
double
nextGuess(double guess, double growth)
{
  return guess * growth * std::sqrt(growth);
}

/** The noise in patches as wide as it asks for itself, from `noise` on.
 *
 * In a patch narrower than the noise is wide the points fill all of the ball, and the deviation is a fixed share of it, larger than
 * the guess: the guess grows until the first scale at which the ball holds a surface.
 */
double
settle(const NoiseProbes& probes, NoiseProbes::Centers& centers, double noise, double spacing)
{
  constexpr double kSettled = 1.03;
  constexpr double kFarFromIt = 1.15;
  constexpr double kMuchWider = 1.25; // a single growth may be off by chance
  double least_growth = kFarFromIt;
  double nearest_noise = 0.0;
  for (int round = 0; round < kMostRounds && noise > 0.0; ++round) {
    const double growth = probes.measure(centers, noise, NoiseProbes::kCoarseStep).noise / noise;
    if (growth < least_growth) {
      least_growth = growth;
      nearest_noise = noise;
    }
    else if (growth > kFarFromIt && noise > kMuchWider * nearest_noise && nearest_noise > 2.0 * spacing)
      return nearest_noise; // parts hardly wider than the noise: no scale settles, this one came nearest to it
    noise = nextGuess(noise, growth);
    if (growth < kSettled && growth > 1.0 / kSettled)
      break;
  }
  return noise;
}

/** A scale below `noise` that settles, too, as where the first patches, of so many nearest points, reached across a thin wall. */
void
settleBelow(const NoiseProbes& probes, double spacing, NoiseProbes::Centers& centers, double& noise)
{
  constexpr double kReach = 2.5;      // spacings; first patches are narrower than stronger noise
  constexpr double kBelow = 0.45;     // patches so narrow show ...
  constexpr double kTwoSheets = 1.16; // ... 1.21 times that or more on one sheet, 1.1 times or less where two were taken for one ...
  constexpr double kFewPoints = 1.19; // ... or, of the few points that are nearest, 1.17
  constexpr double kFromBelow = 0.35, kHolds = 1.1;
  if (!(noise > 0.0 && noise < kReach * spacing))
    return;
  NoiseProbes::Centers below = probes.evenCenters();
  if (noise > spacing)
    probes.measure(below, kBelow * noise, NoiseProbes::kCoarseStep); // lays them onto their sheets
  const double seen = probes.measure(below, kBelow * noise, NoiseProbes::kCoarseStep).noise;
  if (!(seen > 0.0 && seen < (noise < spacing ? kFewPoints : kTwoSheets) * kBelow * noise))
    return;
  below = probes.evenCenters();
  double lower = kFromBelow * noise;
  for (int round = 0; round < kMostRounds; ++round) {
    const double growth = probes.measure(below, lower, NoiseProbes::kCoarseStep).noise / lower;
    if (!(growth > 0.0)) // too few points in layers so thin
      return;
    if (growth < kHolds)
      break;
    lower = nextGuess(lower, growth);
  }
  centers = below;
  noise = lower;
}

/** What the shape of the noise leaves of an estimate that takes it to be normal. */
double
shapeFactor(const NoiseReading& reading)
{
  const double even = std::clamp(2.0 - 2.0 * reading.trimmed / kNormalTrimmed, 0.0, 1.0);
  return 1.0 - even * std::clamp(kEvenExcess * (kNormalKurtosis - reading.kurtosis), 0.0, kMostExcess);
}

double
measureNoise(const NoiseProbes& probes, double spacing)
{
  NoiseProbes::Centers centers = probes.evenCenters();
  double noise = probes.measure(centers, std::numeric_limits<double>::infinity(), NoiseProbes::kCoarseStep).noise;
  noise = settle(probes, centers, noise, spacing);
  settleBelow(probes, spacing, centers, noise);
  if (noise > 0.0)
    noise = probes.measure(centers, noise, 1).noise; // lays all centres onto the surface
  if (!(noise > 0.0))
    return 0.0;
  const std::vector<NoiseReading> patches = probes.readEach(centers, noise, 1);
  const NoiseReading reading = quietTenth(patches);
  const double quietest = reading.noise * shapeFactor(reading);
  const double of_one_sheet = noiseOfOneSheet(probes, centers, quietest, reading.kurtosis);
  return of_one_sheet < quietest ? of_one_sheet : noiseOverAll(probes, centers, noise, patches, quietest);
}

} // namespace

double
estimateNoise(PointsView points, double spacing, unsigned number_of_threads)
{
  return estimateNoise(PointIndex(points, number_of_threads), spacing, number_of_threads);
}

double
estimateNoise(const PointIndex& points, double spacing, unsigned number_of_threads)
{
  if (points.size() < NoiseProbes::kNearest || !(spacing > 0.0))
    return 0.0;
  return measureNoise(NoiseProbes(points, resolveThreads(number_of_threads)), spacing);
}

} // namespace pcl_gpf
