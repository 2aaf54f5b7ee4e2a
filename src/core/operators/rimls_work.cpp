// SPDX-License-Identifier: BSD-3-Clause
#include "rimls_work.h"

#include <pcl_gpf/core/errors.h>

#include "../check_range.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pcl_gpf {

namespace {

/** r_i of an even cloud in spacings. */
constexpr double kRadiusInSpacings = 1.128;
constexpr std::size_t kProbes = 64;
/** Pairs that a cell costs for each point in the ball: its corners and its vertices, some fits for each. */
constexpr double kPairsPerCell = 25.0;
/** Fits until a position has arrived. */
constexpr double kFitsPerPosition = 8.0;
/** Rough cost of a pair on one thread. */
constexpr double kSecondsPerPair = 2e-9;
/** More points in the ball and more seconds than these together are taken for a mistaken radius. */
constexpr double kManyPoints = 5000.0, kLongestSeconds = 100.0;

std::string
rounded(double value)
{
  return std::to_string(std::llround(value));
}

double
supportRadius(const RimlsParameters& p, double spacing)
{
  const double least = p.minimum_radius * p.scale;
  return std::max(p.radius > 0.0 ? boundedRadius(p.radius) : p.scale * kRadiusInSpacings * spacing, least);
}

/** Mean over probes that lie evenly along the curve. */
double
pointsInBall(const PointIndex& points, double radius)
{
  const PointsView view = points.sorted();
  const std::size_t probes = std::min(kProbes, view.size);
  double found = 0.0;
  std::vector<Run> runs;
  for (std::size_t probe = 0; probe < probes; ++probe) {
    const std::size_t i = probe * view.size / probes;
    runs.clear();
    points.tree().collectRuns({{view.x[i], view.y[i], view.z[i]}, {view.x[i], view.y[i], view.z[i]}}, static_cast<float>(radius), runs);
    for (const Run& run : runs)
      found += static_cast<double>(run.end - run.begin);
  }
  return probes > 0 ? found / static_cast<double>(probes) : 0.0;
}

void
refuse(double in_ball, double pairs, const char* work, const char* cure)
{
  const double seconds = pairs * kSecondsPerPair;
  if (in_ball > kManyPoints && seconds > kLongestSeconds)
    throw ExcessiveWork("the support radius holds about " + rounded(in_ball) + " points, " + work + " takes " + rounded(pairs / 1e9) +
                        " billion pairs: roughly " + rounded(seconds) + " s on one thread; choose a smaller radius or scale" + cure);
}

} // namespace

void
refuseExcessiveMeshWork(const RimlsParameters& rimls, const PointIndex& points, double spacing, double cells)
{
  const double in_ball = pointsInBall(points, supportRadius(rimls, spacing));
  refuse(in_ball, in_ball * cells * kPairsPerCell, "the mesh", ", or a lower resolution");
}

void
refuseExcessiveProjection(const RimlsParameters& rimls, const PointIndex& points, double spacing, std::size_t positions)
{
  const double in_ball = pointsInBall(points, supportRadius(rimls, spacing));
  refuse(in_ball, in_ball * static_cast<double>(positions) * kFitsPerPosition, "the projection", "");
}

} // namespace pcl_gpf
