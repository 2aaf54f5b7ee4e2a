// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/scale_selection.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "height_patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Radius of a patch: wide enough to average the noise, narrow enough to lie on a boss. */
constexpr double kPatchNoises = 1.5, kPatchSpacings = 2.5;
/** Neighbourhood over which patches are heard, in patch radii. */
constexpr double kHearing = 4.0;
/** Most probes that a neighbourhood is to hold; more would only cost time. */
constexpr double kMostProbes = 256.0;
/** Mean square of heights, in squares of the noise, from which on they may be those of two sheets. */
constexpr double kSpreadOut = 3.0;
/** Least mean size of heights, in roots of their mean square, of two sheets: 0.8 for noise of any strength, 1 for bare sheets. */
constexpr double kTwoSheets = 0.85;
/** Weight of a variance beside a squared bias: 1 for the mean squared error, 2 for Mallows' C_p; between them by measurement. */
constexpr double kVariances = 1.2;
/** Standard deviation of a filtered point in units of noise / sqrt(data in the ball). */
constexpr double kSpread = 1.15;

/** What the patches about a probe say together. */
struct Hearing {
  double bias_sq;  ///< mean squared bias of the coarse surface
  double noise_sq; ///< variance of heights, no less than the noise of the cloud
};

/** Hears the patches on one face about each probe; no bias where there is none. */
std::vector<Hearing>
hear(const HeightPatches& patches, double noise_sq, double radius, const Probes& probes, std::size_t threads)
{
  const std::size_t padded = probes.size + kQueryBlock;
  AlignedArray<float> heard(padded), bias_sq(padded), variance(padded), wide(padded), wide_size(padded), wide_square(padded);
  for (std::size_t k = 0; k < probes.size; ++k) {
    if (!patches.one_face[k])
      continue;
    const double mean_sq = static_cast<double>(patches.mean[k]) * patches.mean[k], square = patches.mean_square[k];
    heard[k] = 1.0f;
    bias_sq[k] = static_cast<float>(mean_sq - std::max(noise_sq, square - mean_sq) / patches.data[k]);
    variance[k] = static_cast<float>(square - mean_sq);
    if (square > kSpreadOut * noise_sq) {
      wide[k] = 1.0f;
      wide_size[k] = patches.mean_size[k];
      wide_square[k] = patches.mean_square[k];
    }
  }
  const Balls balls(probes, probes.view(), radius, threads);
  const FieldTotals biases = balls.sum(bias_sq, heard), variances = balls.sum(variance, wide), shape = balls.sum(wide_size, wide_square);
  std::vector<Hearing> all(probes.size, {0.0, noise_sq});
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double patches_heard = biases.second[k], patches_wide = variances.second[k];
    if (patches_heard <= 0.0)
      continue;
    // Two sheets drawn together have no mean height, but spread more than noise, and few heights are small.
    const double size = shape.first[k], square = shape.second[k];
    const bool two_sheets = size * size > kTwoSheets * kTwoSheets * square * patches_wide;
    const double merged_sq = two_sheets ? square - patches_wide * noise_sq : 0.0;
    all[k].bias_sq = std::max(0.0, (static_cast<double>(biases.first[k]) + merged_sq) / patches_heard);
    if (!two_sheets)
      all[k].noise_sq = std::max(noise_sq, variances.first[k] / patches_heard);
  }
  return all;
}

} // namespace

std::vector<std::uint8_t>
selectFineScale(const ScaleSelectionParameters& p, const PointIndex& points, SoaBuffer coarse_positions,
                const SoaBuffer& coarse_normals)
{
  checkRange("noise", p.noise, p.noise >= 0.0, ">= 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("fine_radius", p.fine_radius, p.fine_radius > 0.0, "> 0");
  checkRange("coarse_radius", p.coarse_radius, p.coarse_radius > p.fine_radius, "> fine_radius");
  std::vector<std::uint8_t> fine(points.size());
  if (points.size() == 0)
    return fine;
  const std::size_t threads = resolveThreads(p.number_of_threads);
  const double patch = boundedRadius(std::max(kPatchNoises * p.noise, kPatchSpacings * p.spacing));
  const double hearing = boundedRadius(kHearing * patch);
  const double dense = kPi * hearing * hearing / (p.spacing * p.spacing) / kMostProbes;
  std::size_t stride = 1;
  while (static_cast<double>(stride) < dense && stride < points.size())
    stride *= 2;

  const Probes probes(coarse_positions, coarse_normals, stride);
  const HeightPatches patches =
      averageHeights(points.sorted(), std::move(coarse_positions), coarse_normals, p.noise, patch, probes, threads);
  const std::vector<Hearing> heard = hear(patches, p.noise * p.noise, hearing, probes, threads);
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double data = patches.data[k] / (patch * patch); // in a ball of radius 1
    const double variance = kVariances * kSpread * kSpread * heard[k].noise_sq / data;
    const double coarse_risk = heard[k].bias_sq + variance / (p.coarse_radius * p.coarse_radius);
    const double fine_risk = variance / (p.fine_radius * p.fine_radius);
    const std::size_t end = std::min(points.size(), (k + 1) * stride);
    for (std::size_t i = k * stride; i < end; ++i)
      fine[i] = coarse_risk > fine_risk;
  }
  return fine;
}

} // namespace pcl_gpf
