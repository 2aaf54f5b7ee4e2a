// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/parallel.h>

#include "surface_patch.h"
#include "thinned_clouds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostProbes = 320;
/** Every so many probes find the scale; all of them measure it. */
constexpr std::size_t kCoarseStep = 3;
constexpr int kMostRounds = 24;

/** Radius of a neighbourhood in units of the noise: no wider than a patch must be to have a normal, since edges and second sheets
 * come in with every bit; wider, where points are sparse, for kWantedPoints of them, but not beyond kWidestRadius. */
constexpr double kRadius = 2.8;
constexpr double kWidestRadius = 4.0;
constexpr std::size_t kWantedPoints = 200;
constexpr std::size_t kMostPoints = 300;
/** Where the noise is below the spacing the patch is of so many nearest points, and up to kMostNearest along scan lines. */
constexpr std::size_t kNearest = 48;
constexpr std::size_t kMostNearest = 384;

/** Patches across edges only ever show too much noise, so a low quantile is taken, ... */
constexpr double kQuantile = 0.1;
/** ... and the luck of the lowest undone: residuals of n degrees of freedom spread by 1 / sqrt(2 n); this many deviations below. */
constexpr double kLuck = 0.9;
/** Deviation of a normal distribution cut off at kPatchTrim times its own, against the whole. */
constexpr double kTrimmedDeviation = 0.924;

using Point = std::array<float, 3>;

double
lengthSq(const Offset& p)
{
  return p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
}

/** Storage of one task. */
struct Scratch {
  std::vector<Run> runs;
  std::vector<Offset> points;
  std::vector<float> distances_sq;
  std::vector<std::uint32_t> indices;
  std::size_t level = 0; ///< thinned cloud that served the last probe
};

class NoiseProbes {
public:
  NoiseProbes(const PointIndex& points, std::size_t threads) : points_(points), thinned_(points, threads), threads_(threads)
  {
    const PointsView view = points.sorted();
    centers_.resize(std::min(kMostProbes, points.size()));
    for (std::size_t k = 0; k < centers_.size(); ++k) {
      const std::size_t i = k * points.size() / centers_.size(); // even steps along the curve: even over the surface
      centers_[k] = {view.x[i], view.y[i], view.z[i]};
    }
  }

  /** Noise in patches as wide as a `guess` at it asks for. The probes of every `step`th place move onto their surfaces. */
  double
  measure(double guess, std::size_t step)
  {
    std::vector<double> estimates((centers_.size() + step - 1) / step);
    parallelBlocks(estimates.size(), 8, threads_, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      for (std::size_t k = begin; k < end; ++k)
        estimates[k] = measureAt(centers_[k * step], guess, scratch);
    });
    const auto place = estimates.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(estimates.size()) * kQuantile);
    std::nth_element(estimates.begin(), place, estimates.end());
    return std::isfinite(*place) ? *place : 0.0;
  }

private:
  double
  measureAt(Point& center, double guess, Scratch& scratch) const
  {
    SurfacePatch patch;
    if (!std::isfinite(guess) || !fitBall(center, guess, scratch, patch))
      patch = fitNearest(center, guess, scratch);
    if (patch.count == 0 || !std::isfinite(patch.deviation))
      return patch.deviation;
    if (std::isfinite(guess))
      for (std::size_t axis = 0; axis < 3; ++axis)
        center[axis] += static_cast<float>(patch.foot[axis]);
    const double luck = 1.0 - kLuck / std::sqrt(2.0 * static_cast<double>(patch.count - 6));
    return patch.deviation / luck / (std::isfinite(guess) ? kTrimmedDeviation : 1.0);
  }

  /** \return false if the ball holds too few points or those of a line */
  bool
  fitBall(const Point& center, double guess, Scratch& scratch, SurfacePatch& patch) const
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
    const std::size_t stride = (found.size() + kMostPoints - 1) / kMostPoints;
    for (std::size_t i = 0; i * stride < found.size(); ++i)
      found[i] = found[i * stride];
    found.resize((found.size() + stride - 1) / stride);
    patch = fitSurfacePatch(found, radius, guess);
    return !patch.narrow;
  }

  /** The nearest kWantedPoints within the widest radius. \return the radius that they fill */
  double
  widen(const Point& center, double guess, Scratch& scratch) const
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
  fitNearest(const Point& center, double guess, Scratch& scratch) const
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

  const PointIndex& points_;
  const ThinnedClouds thinned_;
  const std::size_t threads_;
  std::vector<Point> centers_;
};

struct Scale {
  double noise = 0.0;
  bool settled = false;
};

/** One step towards the noise at which patches as wide as it asks for show just that noise. Deviations follow the guess at about half
 * its rate there, so the step is made half as long again. */
double
nextGuess(double guess, double growth)
{
  return guess * growth * std::sqrt(growth);
}

/** The noise in patches as wide as it asks for itself.
 *
 * In a patch narrower than the noise is wide the points fill all of the ball, and the deviation is a fixed share of it, larger than
 * the guess: the guess grows until the first scale at which the ball holds a surface.
 */
double
settle(NoiseProbes& probes, double spacing)
{
  constexpr double kSettled = 1.03;
  constexpr double kFarFromIt = 1.15;
  constexpr double kMuchWider = 1.25; // a single growth may be off by chance
  double noise = probes.measure(kUnknown, kCoarseStep);
  double least_growth = kFarFromIt;
  double nearest_noise = 0.0;
  for (int round = 0; round < kMostRounds && noise > 0.0; ++round) {
    const double growth = probes.measure(noise, kCoarseStep) / noise;
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
  for (int round = 0; round < 2 && noise > 0.0; ++round) // once to lay all probes onto the surface, once to measure
    noise = probes.measure(noise, 1);
  return noise;
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
  if (points.size() < kNearest || !(spacing > 0.0))
    return 0.0;
  NoiseProbes probes(points, resolveThreads(number_of_threads));
  return settle(probes, spacing);
}

} // namespace pcl_gpf
