// SPDX-License-Identifier: BSD-3-Clause
#include "orientation_graph.h"

#include <pcl_gpf/core/parallel.h>

#include "../neighborhoods.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 1024;
constexpr double kPi = 3.14159265358979323846;
/** Offsets count as far as they are longer than the noise: half where |d|^2 = 8 noise^2, since two points of one sheet
 * differ by 2 noise^2 along its normal. They must also be longer than 1.4 spacings, or stray points beside an edge
 * would turn, except where the normals make about 45 degrees, as at creases that are sharper than a right angle. */
constexpr double kNoiseShare = 8.0;
constexpr double kSpacingShare = 2.0;
constexpr std::size_t kMostProbes = 4096;
/** The noise is looked for among this many times the neighbours that vote, since a ball of few neighbours ends before
 * the noise does. */
constexpr std::size_t kNoiseNeighbors = 4;
/** Median of the squared difference of two normal deviates of variance 1. */
constexpr double kMedianOfOffsets = 0.91;

float
medianOf(std::vector<float>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Squared spacing of an even surface of which a ball of this squared radius holds k points. */
double
spacingSq(float radius_sq, std::size_t k)
{
  return radius_sq * kPi / static_cast<double>(std::max<std::size_t>(1, k));
}

/** Squared lengths from which on an offset between neighbours counts for more than half. */
struct CountingLength {
  float noise_sq;
  float spacing_sq;
};

CountingLength
countingLength(double noise, float radius_sq, std::size_t k)
{
  return {static_cast<float>(kNoiseShare * noise * noise), static_cast<float>(kSpacingShare * spacingSq(radius_sq, k))};
}

/** Relative sign of the normals of two neighbours. */
std::int16_t
vote(PointsView p, NormalsView n, std::size_t i, std::size_t j, const CountingLength& counting)
{
  const float dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
  const float along_i = n.x[i] * dx + n.y[i] * dy + n.z[i] * dz;
  const float along_j = n.x[j] * dx + n.y[j] * dy + n.z[j] * dz;
  const float cosine = n.x[i] * n.x[j] + n.y[i] * n.y[j] + n.z[i] * n.z[j];
  const float length_sq = dx * dx + dy * dy + dz * dz;
  const float twice = 2.0f * cosine * cosine - 1.0f; // cosine of twice the angle
  const float relative =
      length_sq > 0.0f ? (counting.noise_sq + twice * twice * counting.spacing_sq) / length_sq : 0.0f;
  const float mirrored =
      length_sq > 0.0f ? cosine - 2.0f * along_i * along_j / (length_sq * (1.0f + relative * relative)) : cosine;
  return static_cast<std::int16_t>(std::lround(std::clamp(mirrored, -1.0f, 1.0f) * kFullVote));
}

/** The nearest point of another part for each query of one block; the block's own index when there is none. */
void
nearestOfOtherParts(const PointIndex& points, const std::vector<std::uint32_t>& part, const std::vector<Run>& runs,
                    const std::vector<float>& reach_sq, std::size_t begin, std::size_t end, std::uint32_t* nearest)
{
  const PointsView p = points.sorted();
  for (std::size_t i = begin; i < end; ++i) {
    float best = reach_sq[i];
    nearest[i] = static_cast<std::uint32_t>(i);
    for (const Run& run : runs)
      for (std::uint32_t j = run.begin; j < run.end; ++j) {
        if (part[j] == part[i])
          continue;
        const float dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
        const float distance_sq = dx * dx + dy * dy + dz * dz;
        if (distance_sq < best) {
          best = distance_sq;
          nearest[i] = j;
        }
      }
  }
}

} // namespace

double
noiseAlongNormals(const PointIndex& points, NormalsView normals, std::size_t k, std::size_t threads)
{
  const PointsView p = points.sorted();
  const std::size_t probes = std::min(kMostProbes, p.size);
  std::vector<float> medians(probes);
  parallelBlocks(probes, 64, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<float> offsets_sq;
    std::vector<std::uint32_t> indices;
    for (std::size_t probe = begin; probe < end; ++probe) {
      const std::size_t i = probe * p.size / probes;
      points.tree().nearest(p, {p.x[i], p.y[i], p.z[i]}, kNoiseNeighbors * k + 1, offsets_sq, &indices);
      for (std::size_t e = 0; e < indices.size(); ++e) {
        const std::size_t j = indices[e];
        const float along =
            normals.x[i] * (p.x[j] - p.x[i]) + normals.y[i] * (p.y[j] - p.y[i]) + normals.z[i] * (p.z[j] - p.z[i]);
        offsets_sq[e] = along * along;
      }
      medians[probe] = medianOf(offsets_sq);
    }
  });
  return std::sqrt(medianOf(medians) / kMedianOfOffsets);
}

VoteGraph
neighborVotes(const PointIndex& points, NormalsView normals, std::size_t k, double noise, std::size_t threads)
{
  const PointsView view = points.sorted();
  const std::size_t degree = std::min(k, view.size - 1);
  VoteGraph graph;
  graph.radius_sq.resize(view.size);
  graph.rows.offsets.resize(view.size + 1);
  for (std::size_t i = 0; i <= view.size; ++i)
    graph.rows.offsets[i] = i * degree;
  graph.rows.neighbors.resize(view.size * degree);
  graph.rows.votes.resize(view.size * degree);
  parallelBlocks(view.size, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = begin; i < end; ++i) {
      points.tree().nearest(view, {view.x[i], view.y[i], view.z[i]}, degree + 1, distances_sq, &indices);
      graph.radius_sq[i] = distances_sq.back();
      // Among many coincident points the point itself may be missing: then the last one is left out.
      indices.erase(std::find(indices.begin(), indices.end() - 1, static_cast<std::uint32_t>(i)));
      const CountingLength counting = countingLength(noise, graph.radius_sq[i], degree);
      for (std::size_t e = 0; e < degree; ++e) {
        graph.rows.neighbors[i * degree + e] = indices[e];
        graph.rows.votes[i * degree + e] = vote(view, normals, i, indices[e], counting);
      }
    }
  });
  return graph;
}

VoteRows
gapVotes(const PointIndex& points, NormalsView normals, const std::vector<float>& radius_sq, std::size_t k,
         const std::vector<std::uint32_t>& part, double gap, double noise, std::size_t threads)
{
  const PointsView view = points.sorted();
  const std::size_t degree = std::min(k, view.size - 1);
  std::vector<float> reach_sq(view.size);
  for (std::size_t i = 0; i < view.size; ++i)
    reach_sq[i] = static_cast<float>(gap * gap * spacingSq(radius_sq[i], degree));
  const Neighborhoods near = findNeighborhoods(points.tree(), view, reach_sq.data(), threads);
  std::vector<std::uint32_t> nearest(view.size);
  parallelBlocks(near.run_offsets.size() - 1, 32, threads, [&](std::size_t first, std::size_t last) {
    std::vector<Run> runs;
    for (std::size_t block = first; block < last; ++block) {
      runs.assign(near.runs.begin() + static_cast<std::ptrdiff_t>(near.run_offsets[block]),
                  near.runs.begin() + static_cast<std::ptrdiff_t>(near.run_offsets[block + 1]));
      nearestOfOtherParts(points, part, runs, reach_sq, block * kQueryBlock,
                          std::min(view.size, (block + 1) * kQueryBlock), nearest.data());
    }
  });
  VoteRows rows;
  rows.offsets.push_back(0);
  for (std::size_t i = 0; i < view.size; ++i) {
    if (nearest[i] != i) {
      rows.neighbors.push_back(nearest[i]);
      rows.votes.push_back(vote(view, normals, i, nearest[i], countingLength(noise, radius_sq[i], degree)));
    }
    rows.offsets.push_back(rows.neighbors.size());
  }
  return rows;
}

} // namespace pcl_gpf
