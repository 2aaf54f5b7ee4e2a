// SPDX-License-Identifier: BSD-3-Clause
#include "gap_rounds.h"

#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/operators/gap_filling.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Widest angle, in degrees, at which the weight of data that face otherwise has fallen to 1/e: an edge is close by. */
constexpr double kWidestAngle = 30.0;
/** A point on a curved face has not gone far enough along the bend after one projection. */
constexpr unsigned kProjections = 2;
/** A point keeps at least this share of the data of its own face; rounding and uneven data leave room below 1. */
constexpr float kLeastSupport = 0.8f;

/** The points that were moved, as queries in float, with sums for each. */
struct Moved {
  explicit Moved(std::size_t size)
  : positions(size, kFarAway), normals(size), pull(size), normal_sum(size), weight(size + kQueryBlock)
  {}

  std::size_t size() const { return positions.size(); }
  PointsView view() const { return {positions.x.data(), positions.y.data(), positions.z.data(), size()}; }

  SortedVectors<float> positions, normals, pull, normal_sum;
  AlignedArray<float> weight;
};

/** Data as the loops in float take them, in sorted order. */
struct Data {
  PointsView positions;
  kernels::Vectors<float> normals;
  const float* weight = nullptr; ///< null: all 1
  const ClusterTree* tree = nullptr;
};

SortedVectors<float>
toFloat(kernels::Vectors<double> from, std::size_t size)
{
  SortedVectors<float> to(size);
  for (std::size_t k = 0; k < size; ++k) {
    to.x[k] = static_cast<float>(from.x[k]);
    to.y[k] = static_cast<float>(from.y[k]);
    to.z[k] = static_cast<float>(from.z[k]);
  }
  return to;
}

float
falloffOf(double degrees)
{
  return static_cast<float>(1.0 / (1.0 - std::cos(degrees * kPi / 180.0)));
}

/** The mean plane of the data that face as a point does; data weigh alike within the ball. */
kernels::Projection<float>
meanPlane(const Data& data, double radius, float angle_falloff, Moved& moved)
{
  kernels::Projection<float> a;
  a.queries = moved.positions.vectors();
  a.query_normals = moved.normals.vectors();
  a.data = {data.positions.x, data.positions.y, data.positions.z};
  a.data_normals = data.normals;
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.falloff = 0.5f;
  a.symmetric = true;
  a.symmetry_falloff = angle_falloff;
  a.normal_weights = true;
  a.normal_falloff = angle_falloff;
  a.data_weight = data.weight;
  a.weight_sum = moved.weight.data();
  a.pull = moved.pull.vectors();
  return a;
}

/** Takes the mean normal of these data, sign as it is. */
void
meanNormals(const Data& data, double radius, float angle_falloff, const kernels::Candidates& candidates, std::size_t begin, std::size_t end,
            Moved& moved)
{
  kernels::BilateralNormals n;
  n.queries = moved.positions.vectors();
  n.query_normals = moved.normals.vectors();
  n.data = {data.positions.x, data.positions.y, data.positions.z};
  n.data_normals = data.normals;
  n.radius.radius_sq = static_cast<float>(radius * radius);
  n.angle_falloff = angle_falloff;
  n.data_weight = data.weight;
  n.out = moved.normal_sum.vectors();
  kernels::active().bilateral_normals(candidates, n, begin, end);
  for (std::size_t k = begin * kQueryBlock; k < std::min(moved.size(), end * kQueryBlock); ++k) {
    const float x = moved.normal_sum.x[k], y = moved.normal_sum.y[k], z = moved.normal_sum.z[k];
    const float length = std::sqrt(x * x + y * y + z * z);
    if (length > 0.0f)
      moved.normals.x[k] = x / length, moved.normals.y[k] = y / length, moved.normals.z[k] = z / length;
  }
}

/** How many data face as each point does, by weight, in `moved.weight`; and, when `step`, one step onto their mean plane. */
void
visitData(const Data& data, double radius, float angle_falloff, const Neighborhoods& near, bool step, std::size_t threads, Moved& moved)
{
  const kernels::Candidates candidates = candidatesOf(near);
  const kernels::Projection<float> plane = meanPlane(data, radius, angle_falloff, moved);
  parallelBlocks(blockCount(moved.size()), kBlocksPerTask, threads, [&](std::size_t begin, std::size_t end) {
    if (step)
      meanNormals(data, radius, angle_falloff, candidates, begin, end, moved);
    kernels::active().projection_float(candidates, plane, begin, end);
    for (std::size_t k = begin * kQueryBlock; step && k < std::min(moved.size(), end * kQueryBlock); ++k)
      if (moved.weight[k] > 0.0f) {
        moved.positions.x[k] += moved.pull.x[k] / moved.weight[k];
        moved.positions.y[k] += moved.pull.y[k] / moved.weight[k];
        moved.positions.z[k] += moved.pull.z[k] / moved.weight[k];
      }
  });
}

/** The data of the recursion; `storage` holds normals in float where they are not. */
template <typename Real>
Data
dataOf(const GapRound<Real>& round, const GPFPoints<Real>& cloud, SortedVectors<float>& storage)
{
  Data data;
  if (!round.merged.empty()) {
    data.positions = round.merged.view();
    data.normals = round.merged.normals.vectors();
    data.weight = round.merged.weights.data();
    data.tree = &round.merged.tree;
    return data;
  }
  data.positions = cloud.index().sorted();
  data.tree = &cloud.index().tree();
  if constexpr (std::is_same<Real, float>::value)
    data.normals = cloud.pointNormals();
  else {
    storage = toFloat(cloud.pointNormals(), cloud.pointCount());
    data.normals = storage.vectors();
  }
  return data;
}

/** Tangential moves of all samples. */
template <typename Real>
SoaBuffer
spread(const GapRound<Real>& round, const GPFPoints<Real>& cloud)
{
  SoaBuffer positions, normals;
  const PointsView places = cloud.samples().floatView(positions);
  GapFillingParameters p;
  p.radius = round.parameters.gap_radius_factor * 0.5 * round.parameters.support_radius;
  p.spacing = estimateSpacing(places, round.parameters.number_of_threads);
  p.number_of_threads = round.parameters.number_of_threads;
  if (!(p.spacing > 0.0)) // all at one place
    return SoaBuffer(places.size);
  return movesIntoGaps(p, places, cloud.sampleNormals().floatView(normals));
}

/** Some of the samples, as far along their moves as `share` says. */
template <typename Real>
Moved
take(const std::vector<std::uint32_t>& which, const SoaBuffer& moves, float share, const GPFPoints<Real>& cloud)
{
  const SortedVectors<Real>& from = cloud.samples();
  const SortedVectors<Real>& normals = cloud.sampleNormals();
  Moved moved(which.size());
  for (std::size_t k = 0; k < which.size(); ++k) {
    const std::uint32_t s = which[k];
    moved.positions.x[k] = static_cast<float>(from.x[s]) + share * moves.x[s];
    moved.positions.y[k] = static_cast<float>(from.y[s]) + share * moves.y[s];
    moved.positions.z[k] = static_cast<float>(from.z[s]) + share * moves.z[s];
    moved.normals.x[k] = static_cast<float>(normals.x[s]);
    moved.normals.y[k] = static_cast<float>(normals.y[s]);
    moved.normals.z[k] = static_cast<float>(normals.z[s]);
  }
  return moved;
}

/** Puts those back that landed on their own face. \param[in] before weights of the data of the own face where the points came from */
template <typename Real>
IterationStats
put(const Moved& moved, const AlignedArray<float>& before, const std::vector<std::uint32_t>& which, GPFPoints<Real>& cloud)
{
  IterationStats stats;
  SortedVectors<Real>& to = cloud.samples();
  SortedVectors<Real>& normals = cloud.ownSampleNormals();
  for (std::size_t k = 0; k < which.size(); ++k) {
    if (moved.weight[k] < kLeastSupport * before[k]) // inwards there are more: this went over another edge
      continue;
    const std::uint32_t s = which[k];
    const double length = std::hypot(moved.positions.x[k] - to.x[s], moved.positions.y[k] - to.y[s], moved.positions.z[k] - to.z[s]);
    stats.mean_movement += length;
    stats.max_movement = std::max(stats.max_movement, length);
    to.x[s] = moved.positions.x[k], to.y[s] = moved.positions.y[k], to.z[s] = moved.positions.z[k];
    normals.x[s] = moved.normals.x[k], normals.y[s] = moved.normals.y[k], normals.z[s] = moved.normals.z[k];
  }
  stats.mean_movement /= static_cast<double>(std::max<std::size_t>(1, cloud.sampleCount()));
  return stats;
}

} // namespace

template <typename Real>
IterationStats
runGapRound(const GapRound<Real>& round, GPFPoints<Real>& cloud)
{
  const auto start = std::chrono::steady_clock::now();
  const SoaBuffer moves = spread(round, cloud);
  std::vector<std::uint32_t> which;
  for (std::size_t s = 0; s < moves.size(); ++s)
    if (moves.x[s] != 0.0f || moves.y[s] != 0.0f || moves.z[s] != 0.0f)
      which.push_back(static_cast<std::uint32_t>(s));
  IterationStats stats;
  if (!which.empty()) {
    SortedVectors<float> storage;
    const Data data = dataOf(round, cloud, storage);
    const double radius = 0.5 * round.parameters.support_radius;
    const float falloff = falloffOf(std::min(kWidestAngle, round.parameters.normal_angle));
    const auto near = [&](const Moved& points) {
      return round.search ? transposeLists(round.search(data.positions, points.view(), radius), points.size(), data.positions.size)
                          : findNeighborhoods(*data.tree, points.view(), radius, round.threads);
    };
    Moved before = take(which, moves, 0.0f, cloud), moved = take(which, moves, 1.0f, cloud);
    visitData(data, radius, falloff, near(before), false, round.threads, before);
    for (unsigned k = 0; k < kProjections; ++k)
      visitData(data, radius, falloff, near(moved), true, round.threads, moved);
    stats = put(moved, before.weight, which, cloud);
  }
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

template IterationStats
runGapRound(const GapRound<float>&, GPFPoints<float>&);
template IterationStats
runGapRound(const GapRound<double>&, GPFPoints<double>&);

} // namespace pcl_gpf
