// SPDX-License-Identifier: BSD-3-Clause
#include "measure.h"

#include <pcl_gpf/core/analysis/metrics.h>
#include <pcl_gpf/core/analysis/point_distance.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::quality {

namespace {

constexpr std::uint64_t kReferenceSeed = 12345;
constexpr double kDegrees = 57.295779513082321;

double
meanOf(const std::vector<double>& values)
{
  double sum = 0;
  for (const double v : values)
    sum += v;
  return values.empty() ? Figures::kNone : sum / static_cast<double>(values.size());
}

/** Finite points of a result and what the surface is like at each. */
struct Located {
  std::vector<std::size_t> rows; ///< of the result
  std::vector<SurfaceHit> hits;
  std::vector<double> edge_distances;
  std::vector<std::uint8_t> is_outlier;
  std::vector<std::uint8_t> counts; ///< for the headline figures: all but the outliers that stayed far away
};

Located
locate(const NoisyCloud& cloud, const MethodResult& result, const MeasureOptions& options)
{
  const Surface& surface = *cloud.model.surface;
  Located at;
  for (std::size_t i = 0; i < result.points.size(); ++i)
    if (isMeasurable(result.points[i]))
      at.rows.push_back(i);
  const std::size_t count = at.rows.size();
  at.hits.resize(count);
  at.edge_distances.resize(count);
  at.is_outlier.resize(count);
  at.counts.resize(count);
  const double reach = options.outlier_reach * surface.diagonal();
  parallelBlocks(count, 256, resolveThreads(options.threads), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Position& p = result.points[at.rows[k]];
      at.hits[k] = surface.nearest(p);
      at.edge_distances[k] = surface.edgeDistance(p);
      at.is_outlier[k] = !result.seeds.empty() && cloud.is_outlier[result.seeds[at.rows[k]]] != 0;
      at.counts[k] = at.is_outlier[k] == 0 || std::abs(at.hits[k].signed_distance) <= reach;
    }
  });
  return at;
}

void
measureDistances(const Surface& surface, const Located& at, const MeasureOptions& options, Figures& f)
{
  const double diagonal = surface.diagonal(), unit = 1e4 / diagonal;
  std::vector<double> all, counted, inliers, edge, squares;
  for (std::size_t k = 0; k < at.rows.size(); ++k) {
    const double d = at.hits[k].signed_distance * unit;
    all.push_back(std::abs(d));
    if (at.is_outlier[k] == 0)
      inliers.push_back(std::abs(d));
    if (at.counts[k] == 0)
      continue;
    counted.push_back(d);
    squares.push_back(1e-8 * d * d);
    if (at.edge_distances[k] < options.edge_band * diagonal)
      edge.push_back(std::abs(d));
  }
  f.mean_all = meanOf(all);
  f.mean_inliers = meanOf(inliers);
  f.mean_square = meanOf(squares);
  f.edge_mean = meanOf(edge);
  if (std::any_of(at.edge_distances.begin(), at.edge_distances.end(), [](double d) { return std::isfinite(d); }))
    f.edge_share = static_cast<double>(edge.size()) / static_cast<double>(counted.size());
  if (counted.empty())
    return;
  const DistanceSummary summary = summarizeDistances(counted);
  f.mean = summary.mean;
  f.rms = summary.rms;
  f.p95 = summary.p95;
  f.max = summary.max;
  f.signed_mean = summary.signed_mean;
}

void
measureCoverage(const Surface& surface, const std::vector<Position>& points, const MeasureOptions& options, Figures& f)
{
  const double diagonal = surface.diagonal(), unit = 1e4 / diagonal;
  const PointDistance distance(points);
  std::vector<Position> references;
  for (const SurfaceSample& s : surface.sample(options.references, kReferenceSeed))
    references.push_back(s.point);
  f.coverage = unit * meanOf(distance.distances(references, options.threads));
  constexpr double kEdgeStep = 1e-3;
  f.edge_coverage = unit * meanOf(distance.distances(surface.edgeSamples(kEdgeStep * diagonal), options.threads));
}

/** Angles between lines: the sign of a normal does not count. */
void
measureNormals(const Surface& surface, const MethodResult& result, const Located& at, const MeasureOptions& options,
               Figures& f)
{
  if (result.normals.empty())
    return;
  std::vector<double> all, edge;
  for (std::size_t k = 0; k < at.rows.size(); ++k) {
    const Position n = normalized(result.normals[at.rows[k]]);
    if (at.counts[k] == 0 || !(length(n) > 0.5)) // zero or NaN
      continue;
    all.push_back(kDegrees * std::acos(std::min(std::abs(dot(n, at.hits[k].normal)), 1.0)));
    if (at.edge_distances[k] < options.edge_band * surface.diagonal())
      edge.push_back(all.back());
  }
  f.normal_error = meanOf(all);
  f.normal_error_edge = meanOf(edge);
}

void
measureMovement(const NoisyCloud& cloud, const MethodResult& result, const Located& at, const MeasureOptions& options,
                Figures& f)
{
  if (result.seeds.empty())
    return;
  const Surface& surface = *cloud.model.surface;
  std::vector<double> moves, away;
  for (std::size_t k = 0; k < at.rows.size(); ++k) {
    if (at.is_outlier[k] != 0)
      continue;
    const std::size_t row = at.rows[k];
    const std::uint32_t seed = result.seeds[row];
    moves.push_back(length(subtract(result.points[row], cloud.points[seed])) / cloud.spacing);
    const Position& p = cloud.clean[seed].point;
    if (std::min(surface.edgeDistance(p), surface.boundaryDistance(p)) > options.away_from_edges * cloud.spacing)
      away.push_back(moves.back());
  }
  f.movement = meanOf(moves);
  f.movement_away = meanOf(away);
}

void
measureSheets(const NoisyCloud& cloud, const MethodResult& result, const Located& at, Figures& f)
{
  if (!(cloud.model.sheet_gap > 0) || result.seeds.empty())
    return;
  std::vector<double> wrong, middle;
  for (std::size_t k = 0; k < at.rows.size(); ++k) {
    if (at.is_outlier[k] != 0)
      continue;
    wrong.push_back(at.hits[k].part != cloud.clean[result.seeds[at.rows[k]]].part);
    middle.push_back(std::abs(result.points[at.rows[k]][2]) < cloud.model.sheet_gap / 6);
  }
  f.wrong_sheet = meanOf(wrong);
  f.middle_of_gap = meanOf(middle);
}

/** Against the clean points, whose outermost lie inside the boundary by chance too. */
void
measureRecession(const NoisyCloud& cloud, const MethodResult& result, Figures& f)
{
  if (cloud.model.surface->closed())
    return;
  std::vector<Position> clean;
  for (const SurfaceSample& s : cloud.clean)
    clean.push_back(s.point);
  const double window = 2 * cloud.spacing;
  f.recession = (boundaryInset(*cloud.model.surface, result.points, window) -
                 boundaryInset(*cloud.model.surface, clean, window)) /
                cloud.spacing;
}

/** How far points near the boundary went away from it, tangentially. */
void
measurePull(const NoisyCloud& cloud, const MethodResult& result, const Located& at, Figures& f)
{
  const Surface& surface = *cloud.model.surface;
  if (surface.closed() || result.seeds.empty())
    return;
  const std::vector<BoundarySample> boundary = surface.boundarySamples(0.25 * cloud.spacing);
  std::vector<Position> on_boundary;
  for (const BoundarySample& b : boundary)
    on_boundary.push_back(b.point);
  const PointDistance distance(on_boundary);
  std::vector<double> pulls;
  for (std::size_t k = 0; k < at.rows.size(); ++k) {
    const std::size_t row = at.rows[k];
    const std::uint32_t seed = result.seeds[row];
    const PointDistance::Nearest nearest = distance.nearest(cloud.clean[seed].point);
    if (at.is_outlier[k] == 0 && nearest.distance < 2 * cloud.spacing)
      pulls.push_back(-dot(subtract(result.points[row], cloud.points[seed]), boundary[nearest.index].outward) /
                      cloud.spacing);
  }
  f.boundary_pull = meanOf(pulls);
}

} // namespace

double
boundaryInset(const Surface& surface, const std::vector<Position>& points, double window)
{
  constexpr double kDepth = 10; // windows
  std::vector<double> insets;
  for (const BoundarySample& b : surface.boundarySamples(2 * window)) {
    double farthest = -kDepth * window, nearest = std::numeric_limits<double>::infinity();
    for (const Position& p : points) {
      const Position v = subtract(p, b.point);
      const double outwards = dot(v, b.outward), distance = length(v);
      nearest = std::min(nearest, distance);
      if (outwards > farthest && std::abs(dot(v, b.along)) < window && distance < kDepth * window)
        farthest = outwards;
    }
    insets.push_back(farthest > -kDepth * window ? -farthest
                                                 : nearest); // the latter at the corners of a patch that shrank
  }
  return meanOf(insets);
}

Figures
measure(const NoisyCloud& cloud, const MethodResult& result, const MeasureOptions& options)
{
  Figures f;
  f.points = static_cast<double>(result.points.size());
  f.seconds = result.seconds;
  f.processor_seconds = result.processor_seconds;
  const Located at = locate(cloud, result, options);
  f.not_finite = static_cast<double>(result.points.size() - at.rows.size());
  if (at.rows.empty())
    return f;
  measureDistances(*cloud.model.surface, at, options, f);
  measureCoverage(*cloud.model.surface, result.points, options, f);
  measureNormals(*cloud.model.surface, result, at, options, f);
  measureMovement(cloud, result, at, options, f);
  measureSheets(cloud, result, at, f);
  measureRecession(cloud, result, f);
  measurePull(cloud, result, at, f);
  return f;
}

} // namespace pcl_gpf::quality
