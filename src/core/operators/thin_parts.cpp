// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/thin_parts.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "height_patches.h"

#include <algorithm>
#include <utility>

namespace pcl_gpf {

namespace {

/** Radius of a patch in spacings: about 20 points. */
constexpr double kPatchSpacings = 2.5;
/** Fewest points in a patch: a third of those. Where points are sparser, a yet narrower ball holds none but the point itself. */
constexpr float kFewestPoints = 7.0f;
/** Mean square of heights, in squares of the noise, that noise alone does not reach, beside an edge neither. */
constexpr double kUnexplained = 2.25;
/** Neighbourhood over which a narrower filter is judged, in patch radii. */
constexpr double kHearing = 2.0;
/** Noise s leaves heights of s^2 / (1 + kFollows s^2 / spacing^2) to a narrow filter, but this share of s^2: planes and spheres. */
constexpr double kFollows = 3.5, kLeastLeft = 0.25;
/** Share of those heights from which on they are noise: where the coarse scale saw detail, and where it saw none. */
constexpr double kNoiseIfDetail = 0.7, kNoiseIfSmooth = 0.45;
/** Mean square of heights, in squares of the noise, that is a part with far stronger noise if the coarse scale saw no detail. */
constexpr double kFarStronger = 20.0;
/** Share of points with detail nearby up to which a place is smooth, and from which on it is not. */
constexpr double kSmooth = 0.2, kDetailed = 0.5;

void
checkRanges(const ThinPartsParameters& p)
{
  checkRange("noise", p.noise, p.noise >= 0.0, ">= 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
}

double
patchRadius(const ThinPartsParameters& p)
{
  return boundedRadius(kPatchSpacings * p.spacing);
}

/** Mean square of heights that is left of `noise_sq`. */
double
leftOfNoise(double noise_sq, double spacing)
{
  return noise_sq * std::max(kLeastLeft, 1.0 / (1.0 + kFollows * noise_sq / (spacing * spacing)));
}

/** Share of leftOfNoise() below which heights are none of noise. */
double
noiseShare(double detail)
{
  const double t = std::clamp((detail - kSmooth) / (kDetailed - kSmooth), 0.0, 1.0);
  return kNoiseIfSmooth + (kNoiseIfDetail - kNoiseIfSmooth) * t;
}

} // namespace

ThinParts
findThinParts(const ThinPartsParameters& p, const PointIndex& points, SoaBuffer positions, const SoaBuffer& normals)
{
  checkRanges(p);
  ThinParts found;
  if (points.size() == 0)
    return found;
  const Probes probes(positions, normals, 1);
  const HeightPatches patches = averageHeights(points.sorted(), std::move(positions), normals, p.noise, patchRadius(p), probes,
                                               resolveThreads(p.number_of_threads), false);
  for (std::size_t k = 0; k < probes.size; ++k)
    if (patches.count[k] >= kFewestPoints && patches.mean_square[k] > kUnexplained * p.noise * p.noise) {
      found.places.push_back(static_cast<std::uint32_t>(k));
      found.mean_squares.push_back(patches.mean_square[k]);
    }
  return found;
}

std::vector<std::uint32_t>
confirmThinParts(const ThinPartsParameters& p, const PointIndex& points, const ThinParts& found, SoaBuffer positions,
                 const SoaBuffer& normals, const std::vector<std::uint8_t>& fine)
{
  checkRanges(p);
  if (fine.size() != points.size() || found.mean_squares.size() != found.places.size() ||
      (!found.places.empty() && found.places.back() >= points.size()))
    throw InvalidParameter("places and scales of another cloud");
  std::vector<std::uint32_t> confirmed;
  if (found.places.empty())
    return confirmed;
  const std::size_t threads = resolveThreads(p.number_of_threads);
  const Probes probes(elementsOf(positions.view(), found.places), elementsOf(normals.view(), found.places), 1);
  const HeightPatches patches =
      averageHeights(points.sorted(), std::move(positions), normals, p.noise, patchRadius(p), probes, threads, false);
  const std::size_t padded = probes.size + kQueryBlock;
  AlignedArray<float> before(padded), after(padded), detail(padded);
  for (std::size_t k = 0; k < probes.size; ++k) {
    before[k] = found.mean_squares[k];
    after[k] = patches.mean_square[k];
    detail[k] = fine[found.places[k]] != 0 ? 1.0f : 0.0f;
  }
  const Balls balls(probes, probes.view(), boundedRadius(kHearing * patchRadius(p)), threads);
  const FieldTotals heights = balls.sum(before, after), detailed = balls.sum(detail, after);
  for (std::size_t k = 0; k < probes.size; ++k) {
    const double heard = std::max(1.0, static_cast<double>(heights.count[k]));
    const double was = heights.first[k] / heard, is = heights.second[k] / heard;
    const double detail_near = detailed.first[k] / heard;
    const bool far_stronger = detail_near < kDetailed / 2 && was > kFarStronger * p.noise * p.noise;
    if (!far_stronger && is < noiseShare(detail_near) * leftOfNoise(was, p.spacing))
      confirmed.push_back(found.places[k]);
  }
  return confirmed;
}

} // namespace pcl_gpf
