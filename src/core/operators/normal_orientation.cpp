// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "signed_forest.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr unsigned kMajoritySweeps = 5;
/** A closed surface has no vector area; a hemisphere has half of its area, a cube without one face a fifth. */
constexpr double kClosedVectorArea = 0.25;
/** A point whose neighbours fill a ball this many times as large (squared radius) as those of most of its neighbours is
 * an outlier. */
constexpr float kOutlierRatio = 25.0f;
/** Less than this share of the facing area tells nothing: the far and the near side of a closed part cancel. */
constexpr double kClearMajority = 0.25;

/** Area that each point stands for, in any unit; 0 for outliers, which are not of the surface. */
std::vector<float>
pointAreas(const VoteGraph& graph)
{
  const std::vector<float>& radius_sq = graph.radius_sq;
  std::vector<float> area = radius_sq;
  const auto middle = area.begin() + static_cast<std::ptrdiff_t>(area.size() / 2);
  std::nth_element(area.begin(), middle, area.end());
  const float least = *middle > 0.0f ? 1e-3f * *middle : 1.0f; // coincident points fill no area, but count
  for (std::size_t i = 0; i < area.size(); ++i) {
    const std::size_t begin = graph.rows.offsets[i], end = graph.rows.offsets[i + 1];
    std::size_t denser = 0;
    for (std::size_t e = begin; e < end; ++e)
      denser += kOutlierRatio * (radius_sq[graph.rows.neighbors[e]] + least) < radius_sq[i];
    area[i] = 2 * denser > end - begin ? 0.0f : radius_sq[i] + least;
  }
  return area;
}

/** Sums over one part, weighted by the area of each point. */
struct PartSums {
  double area = 0;
  double center[3] = {0, 0, 0};
  double vector_area[3] = {0, 0, 0};
  double volume = 0;       ///< sum of (p - centre).n
  double facing = 0;       ///< sum of n.v, v unit vector to the viewpoint
  double facing_total = 0; ///< sum of |n.v|
  float top = 0;           ///< greatest z
  double top_normal = 0;   ///< n_z there
};

enum class Rule { Viewpoint, Outward, Root };

struct Side {
  Rule rule = Rule::Root;
  bool flip = false;
};

std::vector<PartSums>
sumParts(PointsView p, NormalsView n, const SignedGroups& parts, const std::vector<float>& area,
         const std::array<double, 3>* viewpoint)
{
  std::vector<PartSums> sums(parts.count);
  for (std::size_t i = 0; i < p.size; ++i) {
    if (area[i] == 0.0f)
      continue;
    PartSums& s = sums[parts.group[i]];
    const double weight = area[i], sign = parts.sign[i];
    const double position[3] = {p.x[i], p.y[i], p.z[i]}, normal[3] = {n.x[i] * sign, n.y[i] * sign, n.z[i] * sign};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.center[axis] += weight * position[axis];
      s.vector_area[axis] += weight * normal[axis];
      s.volume += weight * position[axis] * normal[axis];
    }
    if (s.area == 0 || p.z[i] > s.top) {
      s.top = p.z[i];
      s.top_normal = normal[2];
    }
    s.area += weight;
    if (!viewpoint)
      continue;
    const double v[3] = {(*viewpoint)[0] - position[0], (*viewpoint)[1] - position[1], (*viewpoint)[2] - position[2]};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0.0))
      continue;
    const double facing = (v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2]) / length;
    s.facing += weight * facing;
    s.facing_total += weight * std::abs(facing);
  }
  for (PartSums& s : sums)
    for (std::size_t axis = 0; axis < 3; ++axis)
      s.volume -= s.center[axis] / s.area * s.vector_area[axis];
  return sums;
}

Side
sideOf(const PartSums& s, bool has_viewpoint)
{
  if (has_viewpoint && std::abs(s.facing) > kClearMajority * s.facing_total)
    return {Rule::Viewpoint, s.facing < 0.0};
  const double vector_area = std::sqrt(s.vector_area[0] * s.vector_area[0] + s.vector_area[1] * s.vector_area[1] +
                                       s.vector_area[2] * s.vector_area[2]);
  if (vector_area < kClosedVectorArea * s.area && s.volume != 0.0)
    return {Rule::Outward, s.volume < 0.0};
  if (has_viewpoint && s.facing != 0.0)
    return {Rule::Viewpoint, s.facing < 0.0};
  return {Rule::Root, s.top_normal < 0.0};
}

void
chooseSides(PointsView points, NormalsView normals, const std::vector<float>& area,
            const std::array<double, 3>* viewpoint, SignedGroups& parts, NormalOrientationStatistics& statistics)
{
  std::vector<std::int8_t> side;
  for (const PartSums& sums : sumParts(points, normals, parts, area, viewpoint)) {
    const Side chosen = sideOf(sums, viewpoint != nullptr);
    statistics.parts_by_viewpoint += chosen.rule == Rule::Viewpoint;
    statistics.parts_outward += chosen.rule == Rule::Outward;
    statistics.parts_by_root += chosen.rule == Rule::Root;
    side.push_back(chosen.flip ? -1 : 1);
  }
  statistics.parts = parts.count;
  for (std::size_t i = 0; i < points.size; ++i)
    parts.sign[i] = static_cast<std::int8_t>(parts.sign[i] * side[parts.group[i]]);
}

void
applySigns(const std::vector<std::int8_t>& sign, MutableVectorsView normals, NormalOrientationStatistics& statistics)
{
  for (std::size_t i = 0; i < normals.size; ++i)
    if (sign[i] < 0) {
      normals.x[i] = -normals.x[i];
      normals.y[i] = -normals.y[i];
      normals.z[i] = -normals.z[i];
      ++statistics.flipped;
    }
}

void
countVotes(const VoteRows& rows, const SignedGroups& groups, NormalOrientationStatistics& statistics)
{
  statistics.votes += rows.votes.size();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t e = rows.offsets[i]; e < rows.offsets[i + 1]; ++e)
      statistics.disagreeing_votes += rows.votes[e] * groups.sign[i] * groups.sign[rows.neighbors[e]] < 0;
}

void
report(const ProgressCallback& progress, double fraction)
{
  if (progress && !progress(fraction))
    throw Cancelled();
}

} // namespace

void
validate(const NormalOrientationParameters& p)
{
  checkRange("orientation neighbors", p.neighbors, p.neighbors >= 3 && p.neighbors <= 100, "3 .. 100");
  checkRange("orientation noise", p.noise, p.noise >= 0.0, ">= 0, 0 = estimated");
  checkRange("orientation gap", p.gap, p.gap >= 0.0 && p.gap <= 100.0, "0 .. 100 spacings");
}

NormalOrientationStatistics
orientNormals(const NormalOrientationParameters& parameters, PointsView points, MutableVectorsView normals,
              const std::array<double, 3>* viewpoint, const ProgressCallback& progress)
{
  const PointIndex index(points, parameters.number_of_threads);
  SoaBuffer sorted(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    sorted.x[k] = normals.x[index.order()[k]];
    sorted.y[k] = normals.y[index.order()[k]];
    sorted.z[k] = normals.z[index.order()[k]];
  }
  const NormalOrientationStatistics statistics = orientNormals(parameters, index, sorted.view(), viewpoint, progress);
  for (std::size_t k = 0; k < index.size(); ++k) {
    normals.x[index.order()[k]] = sorted.x[k];
    normals.y[index.order()[k]] = sorted.y[k];
    normals.z[index.order()[k]] = sorted.z[k];
  }
  return statistics;
}

NormalOrientationStatistics
orientNormals(const NormalOrientationParameters& parameters, const PointIndex& points, MutableVectorsView normals,
              const std::array<double, 3>* viewpoint, const ProgressCallback& progress)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  NormalOrientationStatistics statistics;
  const std::size_t threads = resolveThreads(parameters.number_of_threads);
  if (points.size() == 0)
    return statistics;
  report(progress, 0.0);
  statistics.noise =
      parameters.noise > 0.0 ? parameters.noise : noiseAlongNormals(points, normals, parameters.neighbors, threads);
  const VoteGraph graph = neighborVotes(points, normals, parameters.neighbors, statistics.noise, threads);
  report(progress, 0.6);
  SignedGroups parts = singleGroups(points.size());
  joinGroups(graph.rows, parts);
  report(progress, 0.8);
  followMajority(graph.rows, parts, kMajoritySweeps);
  if (parts.count > 1 && parameters.gap > 0.0) {
    const VoteRows gaps = gapVotes(points, normals, graph.radius_sq, parameters.neighbors, parts.group, parameters.gap,
                                   statistics.noise, threads);
    joinGroups(gaps, parts);
    countVotes(gaps, parts, statistics);
  }
  countVotes(graph.rows, parts, statistics);
  chooseSides(points.sorted(), normals, pointAreas(graph), viewpoint, parts, statistics);
  applySigns(parts.sign, normals, statistics);
  report(progress, 1.0);
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return statistics;
}

} // namespace pcl_gpf
