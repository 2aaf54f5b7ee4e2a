// SPDX-License-Identifier: BSD-3-Clause
#include "merged_points.h"

#include "ball_count.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Points that share one choice of group, after the balls about its first, middle and last point; a power of two. */
constexpr std::size_t kChunk = 1024;
constexpr std::size_t kPointsPerTask = 8 * kChunk;
/** Means as a share of the points above which merging is not worth its memory. */
constexpr double kWorthwhile = 0.75;
/** Groups from which on it is worth it however few they are: the pairs of a pile grow with the square of its points. */
constexpr std::uint16_t kPileGroup = 16;

/** Sums over the points of one mean. */
struct Mean {
  std::array<double, 3> position{}, normal{};
  std::array<float, 3> direction{}; ///< normal of the first point
  std::size_t first = 0;
  float count = 0.0f;
};

double
radiusSqOf(const BallRadius& radius, std::size_t i)
{
  return radius.per_point_sq ? radius.per_point_sq[i] : radius.radius * radius.radius;
}

/** Chooses how many points of a chunk make a group. */
class GroupChoice {
public:
  GroupChoice(const PointIndex& points, const BallRadius& radius, std::size_t merge_above)
  : points_(points), radius_(radius), merge_above_(merge_above)
  {}

  std::size_t
  ofChunk(std::size_t begin, std::size_t end)
  {
    std::size_t held = merge_above_ * MergedPoints::kLargestGroup;
    for (const std::size_t i : {begin, begin + (end - begin) / 2, end - 1})
      if (held > merge_above_)
        held = std::min(held, heldBy(i));
    std::size_t group = 1;
    for (; held > merge_above_ && group < MergedPoints::kLargestGroup; held = (held + 1) / 2)
      group *= 2;
    return group;
  }

private:
  /** Points within the radius of point i, or some number that asks for the largest groups. */
  std::size_t
  heldBy(std::size_t i)
  {
    return countBall(points_.tree(), points_.sorted(), i, static_cast<float>(radiusSqOf(radius_, i)), runs_,
                     merge_above_ * MergedPoints::kLargestGroup);
  }

  const PointIndex& points_;
  BallRadius radius_;
  std::size_t merge_above_;
  std::vector<Run> runs_;
};

/** Makes means of consecutive points, or only counts them: the work twice, but no room for what may not be wanted. */
class Merger {
public:
  /** \param[out] merged receives the means from `first_mean` on; null: they are counted */
  Merger(const PointIndex& points, VectorsView normals, const BallRadius& radius, MergedPoints* merged,
         std::size_t first_mean)
  : p_(points.sorted())
  , n_(normals)
  , radius_(radius)
  , merged_(merged)
  , end_(first_mean)
  {}

  void
  addChunk(std::size_t begin, std::size_t end, std::size_t group)
  {
    for (std::size_t first = begin; first < end; first += group)
      addGroup(first, std::min(end, first + group));
  }

  /** Behind the last mean. */
  std::size_t end() const { return end_; }

private:
  /** Halves a group until it is small against the radius. */
  void
  addGroup(std::size_t begin, std::size_t end)
  {
    if (end - begin > 1 && isWide(begin, end)) {
      const std::size_t middle = begin + (end - begin) / 2;
      addGroup(begin, middle);
      addGroup(middle, end);
      return;
    }
    means_.clear();
    for (std::size_t i = begin; i < end; ++i)
      addPoint(i);
    for (std::size_t m = 0; merged_ && m < means_.size(); ++m)
      write(means_[m], end_ + m);
    end_ += means_.size();
  }

  bool
  isWide(std::size_t begin, std::size_t end) const
  {
    const float* axes[3] = {p_.x, p_.y, p_.z};
    double diagonal_sq = 0.0;
    for (const float* axis : axes) {
      const auto range = std::minmax_element(axis + begin, axis + end);
      const double extent = static_cast<double>(*range.second) - static_cast<double>(*range.first);
      diagonal_sq += extent * extent;
    }
    double radius_sq = radiusSqOf(radius_, begin);
    for (std::size_t i = begin + 1; radius_.per_point_sq && i < end; ++i)
      radius_sq = std::min(radius_sq, radiusSqOf(radius_, i));
    return diagonal_sq > MergedPoints::kWidestShare * MergedPoints::kWidestShare * radius_sq;
  }

  /** To the first mean of the group that faces the same way, or a new one. */
  void
  addPoint(std::size_t i)
  {
    const std::array<float, 3> normal = n_.x ? std::array<float, 3>{n_.x[i], n_.y[i], n_.z[i]} : std::array<float, 3>{};
    std::size_t m = 0;
    float cosine = 1.0f;
    for (; m < means_.size(); ++m) {
      const std::array<float, 3>& direction = means_[m].direction;
      cosine = n_.x ? normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2] : 1.0f;
      if (std::abs(cosine) >= MergedPoints::kSameDirection)
        break;
    }
    if (m == means_.size()) {
      means_.emplace_back();
      means_[m].direction = normal;
      means_[m].first = i;
      cosine = 1.0f;
    }
    Mean& mean = means_[m];
    const double position[3] = {p_.x[i], p_.y[i], p_.z[i]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mean.position[axis] += position[axis];
      mean.normal[axis] += std::copysign(1.0, cosine) * static_cast<double>(normal[axis]);
    }
    mean.count += 1.0f;
    if (merged_ && !merged_->mean_of.empty())
      merged_->mean_of[i] = static_cast<std::uint32_t>(end_ + m);
  }

  /** A mean of one point is that point to the last bit. */
  void
  write(const Mean& mean, std::size_t to)
  {
    const bool alone = mean.count == 1.0f;
    const float* from[3] = {p_.x, p_.y, p_.z};
    float* positions[3] = {merged_->positions.x.data(), merged_->positions.y.data(), merged_->positions.z.data()};
    float* normals[3] = {merged_->normals.x.data(), merged_->normals.y.data(), merged_->normals.z.data()};
    const auto& n = mean.normal;
    const double length = alone || !n_.x ? 1.0 : std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    merged_->weights[to] = mean.count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      positions[axis][to] =
          alone ? from[axis][mean.first] : static_cast<float>(mean.position[axis] / static_cast<double>(mean.count));
      if (n_.x)
        normals[axis][to] = static_cast<float>(n[axis] / length);
    }
  }

  PointsView p_;
  VectorsView n_;
  BallRadius radius_;
  MergedPoints* merged_;
  std::size_t end_;
  std::vector<Mean> means_; ///< of the group at hand
};

} // namespace

MergedPoints
mergePoints(const PointIndex& points, VectorsView normals, const BallRadius& radius, unsigned merge_above,
            bool want_mean_of, std::size_t threads)
{
  MergedPoints merged;
  if (merge_above == 0 || points.size() <= merge_above)
    return merged;
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk,
                    tasks = (points.size() + kPointsPerTask - 1) / kPointsPerTask;
  std::vector<std::uint16_t> groups(chunks);
  std::vector<std::size_t> offsets(tasks + 1, 0);
  const auto run = [&](std::size_t begin, std::size_t end, Merger merger) {
    for (std::size_t first = begin; first < end; first += kChunk)
      merger.addChunk(first, std::min(end, first + kChunk), groups[first / kChunk]);
    return merger.end();
  };
  parallelBlocks(points.size(), kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    GroupChoice choice(points, radius, merge_above);
    for (std::size_t first = begin; first < end; first += kChunk)
      groups[first / kChunk] = static_cast<std::uint16_t>(choice.ofChunk(first, std::min(end, first + kChunk)));
    offsets[begin / kPointsPerTask + 1] = run(begin, end, Merger(points, normals, radius, nullptr, 0));
  });
  for (std::size_t task = 0; task < tasks; ++task)
    offsets[task + 1] += offsets[task];
  const bool pile = !groups.empty() && *std::max_element(groups.begin(), groups.end()) >= kPileGroup;
  if (!pile && static_cast<double>(offsets.back()) > kWorthwhile * static_cast<double>(points.size()))
    return merged;
  merged.positions = SortedVectors<float>(offsets.back(), kFarAway);
  if (normals.x)
    merged.normals = SortedVectors<float>(offsets.back());
  merged.weights = AlignedArray<float>(offsets.back() + kQueryBlock);
  merged.mean_of.resize(want_mean_of ? points.size() : 0);
  parallelBlocks(points.size(), kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    run(begin, end, Merger(points, normals, radius, &merged, offsets[begin / kPointsPerTask]));
  });
  merged.tree.fit(merged.view(), threads);
  return merged;
}

} // namespace pcl_gpf
