// SPDX-License-Identifier: BSD-3-Clause
#include "move_limit.h"

#include "scale_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_gpf {

namespace {

/** Most noises that a point may move. */
constexpr double kNoises = 6.0;
/** Noise below this share of the spacing is none: the cloud is clean and stays as it is. */
constexpr double kClean = 0.02;
/** Where more than this share of the moves is longer than the limit, the noise is uneven and was measured in a quiet part. */
constexpr double kUneven = 0.1;
/** Moves beyond this many noises are no longer those of noise alone. */
constexpr double kNoiseAlone = 1.3;

double
shareOfLonger(double longest, const SoaBuffer& moves)
{
  std::size_t longer = 0;
  for (std::size_t k = 0; k < moves.size(); ++k)
    longer += lengthOf(moves, k) > longest;
  return moves.size() > 0 ? static_cast<double>(longer) / static_cast<double>(moves.size()) : 0.0;
}

/** Standard deviation that half of the moves tell. */
double
usualMove(const SoaBuffer& moves)
{
  constexpr double kMedianOfNormal = 0.6745;
  std::vector<double> lengths(moves.size());
  for (std::size_t k = 0; k < lengths.size(); ++k)
    lengths[k] = lengthOf(moves, k);
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return lengths.empty() ? 0.0 : *middle / kMedianOfNormal;
}

/** Normalised frame; infinity = no limit. */
double
longestMove(const DenoiseParameters& wanted, double noise, double spacing, const LocalFrame& frame, const SoaBuffer& moves)
{
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  if (wanted.max_move > 0.0)
    return frame.lengthToLocal(wanted.max_move);
  const bool estimated = !runsInDouble(wanted.gpf) && wanted.gpf.repulsion_weight == 0.0 && wanted.gpf.support_radius == 0.0;
  if (!estimated)
    return kNoLimit;
  const double points = static_cast<double>(moves.size()) / wanted.gpf.sample_ratio;
  if (points < static_cast<double>(kFewestForNoise) ||
      (noise < biasOfFewPoints(spacing, points) && usualMove(moves) > kNoiseAlone * noise))
    return 0.0; // more harm than good
  const double limit = kNoises * noise;
  return noise > kClean * spacing && shareOfLonger(limit, moves) > kUneven ? kNoLimit : limit;
}

/** Cuts a move to `longest`. \return whether it was longer */
bool
cutMove(double longest, std::size_t k, const SoaBuffer& from, SoaBuffer& to)
{
  const double distance = lengthOf(from, k);
  if (!(distance > longest))
    return false;
  const double share = longest / distance * (1.0 - 1e-6); // rounding must not pass the limit
  to.x[k] = static_cast<float>(from.x[k] * share);
  to.y[k] = static_cast<float>(from.y[k] * share);
  to.z[k] = static_cast<float>(from.z[k] * share);
  return true;
}

ParameterOrigin
originOf(const DenoiseParameters& wanted, double limit)
{
  if (wanted.max_move > 0.0)
    return {"max_move", limit, "user", ""};
  if (std::isinf(limit))
    return {"max_move", limit, "default",
            "no limit where the radius is given, in the paper's recursion, and where noise is uneven"};
  if (limit == 0.0)
    return {"max_move", limit, "estimated", "no noise, or too few points to tell it from the shape"};
  return {"max_move", limit, "estimated", "6 x noise" + strengthNote(wanted.strength)};
}

} // namespace

double
lengthOf(const SoaBuffer& moves, std::size_t k)
{
  const double x = moves.x[k], y = moves.y[k], z = moves.z[k];
  return std::sqrt(x * x + y * y + z * z);
}

void
limitMoves(const DenoiseParameters& wanted, double noise, double spacing, const LocalFrame& frame, FilteredCloud& cloud, DenoiseResult& result)
{
  // The noise bounds what the filter may do: a point that it moved too far has no business on an edge, or in the gap beside it. The
  // user's limit bounds everything.
  const bool before_gaps = wanted.max_move == 0.0 && cloud.before_gaps.size() > 0;
  const SoaBuffer& moves = before_gaps ? cloud.before_gaps : cloud.displacements;
  const double longest = longestMove(wanted, noise, spacing, frame, moves);
  result.limited_points = 0;
  for (std::size_t k = 0; k < moves.size(); ++k)
    result.limited_points += cutMove(longest, k, moves, cloud.displacements);
  if (longest == 0.0) // nothing was taken out
    std::fill(cloud.sigma.begin(), cloud.sigma.end(), 0.0);
  result.max_move = result.max_iteration_move = frame.lengthToWorld(longest);
  result.parameters.push_back(originOf(wanted, result.max_move));
  if (!before_gaps || std::isinf(longest))
    return;
  result.parameters.back().reason += " in the iterations, none for gap filling";
  result.parameters.back().value = result.max_move = std::numeric_limits<double>::infinity(); // of the whole move
}

} // namespace pcl_gpf
