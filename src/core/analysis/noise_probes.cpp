// SPDX-License-Identifier: BSD-3-Clause
#include "noise_probes.h"
#include "pooled_heights.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kMostProbes = 320;

/** Radius of a neighbourhood in units of the noise: no wider than a patch must be to have a normal, since edges and second sheets
 * come in with every bit; wider, where points are sparse, for kWantedPoints of them, but not beyond kWidestRadius. */
constexpr double kRadius = 2.8;
constexpr double kWidestRadius = 4.0;
constexpr std::size_t kWantedPoints = 200;
constexpr std::size_t kMostPoints = 300;
/** Most of the nearest points that a patch is of, along scan lines. */
constexpr std::size_t kMostNearest = 384;

/** Patches across edges only ever show too much noise, so a low quantile is taken, ... */
constexpr double kQuantile = 0.1;
/** ... and the luck of the lowest undone: residuals of n degrees of freedom spread by 1 / sqrt(2 n); this many deviations below. */
constexpr double kLuck = 0.9;
/** Deviation of a normal distribution cut off at kPatchTrim times its own, against the whole. */
constexpr double kTrimmedDeviation = 0.924;

double
lengthSq(const Offset& p)
{
  return p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
}

/** Thins points to every `stride`th. */
void
keepEvery(std::size_t stride, std::vector<Offset>& points)
{
  if (stride <= 1)
    return;
  for (std::size_t i = 0; i * stride < points.size(); ++i)
    points[i] = points[i * stride];
  points.resize((points.size() + stride - 1) / stride);
}

/** What `measure` finds at every step-th centre, which it may move. */
template <class Found, class Scratch, class Centers, class Measure>
std::vector<Found>
ofEach(Centers& centers, std::size_t step, std::size_t threads, const Measure& measure)
{
  std::vector<Found> found((centers.size() + step - 1) / step);
  parallelBlocks(found.size(), 8, threads, [&](std::size_t begin, std::size_t end) {
    Scratch scratch;
    for (std::size_t k = begin; k < end; ++k)
      found[k] = measure(centers[k * step], scratch);
  });
  return found;
}

} // namespace

NoiseReading
quietTenth(std::vector<NoiseReading> patches)
{
  std::sort(patches.begin(), patches.end(), [](const NoiseReading& a, const NoiseReading& b) {
    return a.noise < b.noise || (a.noise == b.noise && a.kurtosis < b.kurtosis);
  });
  const auto place = static_cast<std::size_t>(static_cast<double>(patches.size()) * kQuantile);
  NoiseReading reading{std::isfinite(patches[place].noise) ? patches[place].noise : 0.0, 0.0, 0.0, 0.0, 0.0};
  const std::size_t lower_half = std::max<std::size_t>(1, patches.size() / 2);
  for (std::size_t k = 0; k < lower_half; ++k) {
    reading.kurtosis += patches[k].kurtosis / static_cast<double>(lower_half);
    reading.trimmed += patches[k].trimmed / static_cast<double>(lower_half);
  }
  return reading;
}

/** Storage of one task. */
struct NoiseProbes::Scratch {
  std::vector<Run> runs;
  std::vector<Offset> points;
  std::vector<float> distances_sq;
  std::vector<std::uint32_t> indices;
  std::size_t level = 0; ///< thinned cloud that served the last probe
};

NoiseProbes::Centers
NoiseProbes::evenCenters() const
{
  const PointsView view = points_.sorted();
  Centers centers(std::min(kMostProbes, points_.size()));
  for (std::size_t k = 0; k < centers.size(); ++k) {
    const std::size_t i = k * points_.size() / centers.size(); // even steps along the curve: even over the surface
    centers[k] = {view.x[i], view.y[i], view.z[i]};
  }
  return centers;
}

std::vector<NoiseReading>
NoiseProbes::readEach(Centers& centers, double guess, std::size_t step) const
{
  return ofEach<NoiseReading, Scratch>(
      centers, step, threads_, [&](Center& center, Scratch& scratch) { return measureAt(center, guess, scratch); });
}

std::vector<NoiseLevel>
NoiseProbes::settleEach(const Centers& centers, const std::vector<NoiseReading>& at_guess, double guess, std::size_t step) const
{
  return ofEach<NoiseLevel, Scratch>(centers, step, threads_, [&](const Center& center, Scratch& scratch) {
    return settleAt(center, at_guess[static_cast<std::size_t>(&center - centers.data())], guess, scratch);
  });
}

NoiseLevel
NoiseProbes::settleAt(Center center, NoiseReading reading, double guess, Scratch& scratch) const
{
  constexpr int kRounds = 9;
  constexpr double kSettled = 0.05, kMostTrimmed = 0.06, kHighest = 3.5, kLowest = 0.3; // guesses
  double noise = guess;
  for (int round = 0; round < kRounds && noise < kHighest * guess && noise > kLowest * guess; ++round) {
    const double growth = reading.level / noise;
    if (!std::isfinite(growth) || !(growth > 0.0))
      break;
    if (std::abs(growth - 1.0) < kSettled)
      return {center, reading.trimmed < kMostTrimmed ? reading.level : 0.0, reading.reach, reading.kurtosis};
    noise *= growth * std::sqrt(growth);
    reading = measureAt(center, noise, scratch);
  }
  return {center, 0.0, 0.0, 0.0};
}

std::vector<PatchHeights>
NoiseProbes::heightsOfEach(const Centers& centers, double guess, std::size_t step) const
{
  return ofEach<PatchHeights, Scratch>(
      centers, step, threads_, [&](const Center& center, Scratch& scratch) { return heightsAt(center, guess, scratch); });
}

PatchHeights
NoiseProbes::heightsAt(const Center& center, double guess, Scratch& scratch) const
{
  constexpr double kLateral = 2.2;
  constexpr std::size_t kWanted = 800, kMost = 1500;
  const double radius = guess * std::hypot(kLateral, kPooledHeight);
  std::vector<Offset>& points = scratch.points;
  std::size_t level = thinned_.size();
  do
    thinned_.collect(--level, center, radius, scratch.runs, points);
  while (points.size() < kWanted && level > 0);
  keepEvery((points.size() + kMost - 1) / kMost, points);
  PatchHeights found;
  if (points.size() >= kNearest)
    found.patch = fitSurfacePatch(points, radius, guess, kPooledHeight, &found.heights);
  return found;
}

NoiseReading
NoiseProbes::measureAt(Center& center, double guess, Scratch& scratch) const
{
  SurfacePatch patch;
  if (!std::isfinite(guess) || !fitBall(center, guess, scratch, patch))
    patch = fitNearest(center, guess, scratch);
  if (patch.count == 0 || !std::isfinite(patch.deviation))
    return {patch.deviation, 0.0, 0.0, patch.deviation, patch.reach};
  if (std::isfinite(guess))
    for (std::size_t axis = 0; axis < 3; ++axis)
      center[axis] += static_cast<float>(patch.foot[axis]);
  const double luck = 1.0 - kLuck / std::sqrt(2.0 * static_cast<double>(patch.count - 6));
  const double deviation = patch.deviation / (std::isfinite(guess) ? kTrimmedDeviation : 1.0);
  return {deviation / luck, patch.kurtosis, patch.trimmed, deviation, patch.reach};
}

bool
NoiseProbes::fitBall(const Center& center, double guess, Scratch& scratch, SurfacePatch& patch) const
{
  std::vector<Offset>& found = scratch.points;
  double radius = kRadius * guess;
  std::size_t level = std::min(scratch.level + 1, thinned_.size() - 1);
  thinned_.collect(level, center, radius, scratch.runs, found);
  while (found.size() < kWantedPoints && level > 0)
    thinned_.collect(--level, center, radius, scratch.runs, found);
  scratch.level = level;
  if (found.size() < kWantedPoints)
    radius = widen(center, guess, scratch);
  if (found.size() < kNearest)
    return false;
  keepEvery((found.size() + kMostPoints - 1) / kMostPoints, found);
  patch = fitSurfacePatch(found, radius, guess);
  return !patch.narrow;
}

double
NoiseProbes::widen(const Center& center, double guess, Scratch& scratch) const
{
  std::vector<Offset>& found = scratch.points;
  thinned_.collect(0, center, kWidestRadius * guess, scratch.runs, found);
  if (found.size() <= kWantedPoints)
    return kWidestRadius * guess;
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(kWantedPoints);
  std::nth_element(found.begin(), last, found.end(), [](const Offset& a, const Offset& b) {
    return lengthSq(a) < lengthSq(b);
  });
  found.resize(kWantedPoints + 1);
  return std::sqrt(lengthSq(found.back()));
}

SurfacePatch
NoiseProbes::fitNearest(const Center& center, double guess, Scratch& scratch) const
{
  const PointsView view = points_.sorted();
  SurfacePatch patch;
  for (std::size_t count = kNearest; count <= kMostNearest && patch.narrow; count *= 2) {
    points_.tree().nearest(view, center, count, scratch.distances_sq, &scratch.indices);
    scratch.points.clear();
    for (const std::uint32_t i : scratch.indices)
      scratch.points.push_back({view.x[i] - center[0], view.y[i] - center[1], view.z[i] - center[2]});
    patch = fitSurfacePatch(scratch.points, std::sqrt(scratch.distances_sq.back()), guess);
  }
  return patch;
}

} // namespace pcl_gpf
