// SPDX-License-Identifier: BSD-3-Clause
#include "quadric_data.h"

#include <pcl_gpf/core/parallel.h>

#include "../neighborhoods.h"
#include "eigen_vectors.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace pcl_gpf {

namespace {

/** Heights count up to this many deviations, of the noise or of half of the points. */
constexpr double kLongest = 4.0, kMedianToDeviation = 1.4826;

void
cutOutliers(double noise, std::size_t count, AlignedArray<float>& heights)
{
  std::vector<float> sizes(count);
  for (std::size_t k = 0; k < count; ++k)
    sizes[k] = std::abs(heights[k]);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const auto longest = static_cast<float>(kLongest * std::max(noise, kMedianToDeviation * static_cast<double>(*middle)));
  for (std::size_t k = 0; k < count; ++k)
    heights[k] = std::min(std::max(heights[k], -longest), longest);
}

} // namespace

QueryFrames::QueryFrames(const QuadricData& data, const std::vector<std::uint32_t>& places) : QueryFrames(places.size())
{
  for (std::size_t q = 0; q < places.size(); ++q) {
    const Eigen::Vector3d normal = data.normal(places[q]);
    Eigen::Index least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Eigen::Vector3d axis = normal.cross(Eigen::Vector3d::Unit(least)).normalized();
    setVector(data.position(places[q]), origin, q);
    setVector(axis, u, q);
    setVector(normal.cross(axis), v, q);
    setVector(normal, n, q);
  }
}

QueryFrame
QueryFrames::of(std::size_t q) const
{
  return {vectorAt(origin, q), vectorAt(u, q), vectorAt(v, q), vectorAt(n, q)};
}

QuadricSums::QuadricSums(std::size_t queries)
: sums_((queries + kQueries - 1) / kQueries * kQueries * kernels::QuadricMoments::kSums)
{}

QuadricData::QuadricData(const QuadricFitParameters& p, PointsView noisy, VectorsView positions, VectorsView normals, std::size_t threads)
: p_(p)
, threads_(threads)
, points_(positions, p.number_of_threads)
, normals_(gather<float>(normals, {}, points_.order(), 0.0f, threads))
, heights_(positions.size + kQueryBlock)
{
  const PointsView sorted = points_.sorted();
  for (std::size_t k = 0; k < sorted.size; ++k) {
    const std::uint32_t i = points_.order()[k];
    heights_[k] = (noisy.x[i] - sorted.x[k]) * normals_.x[k] + (noisy.y[i] - sorted.y[k]) * normals_.y[k] +
                  (noisy.z[i] - sorted.z[k]) * normals_.z[k];
  }
  if (sorted.size > 0)
    cutOutliers(p.noise, sorted.size, heights_);
}

bool
QuadricData::average(double radius)
{
  means_ = mergePoints(points_, {normals_.x.data(), normals_.y.data(), normals_.z.data(), points_.size()}, {radius, nullptr}, p_.merge_above,
                       true, threads_);
  if (means_.empty())
    return false;
  averageHeights();
  averageScatter(radius);
  return true;
}

void
QuadricData::averageHeights()
{
  const std::size_t count = means_.size();
  mean_height_ = AlignedArray<float>(count + kQueryBlock);
  noisy_ = SortedVectors<float>(count);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const std::uint32_t m = means_.mean_of[k];
    const float share = 1.0f / means_.weights[m];
    const float facing = normals_.x[k] * means_.normals.x[m] + normals_.y[k] * means_.normals.y[m] + normals_.z[k] * means_.normals.z[m];
    const float raise = share * heights_[k];
    mean_height_[m] += std::copysign(raise, raise * facing);
    noisy_.x[m] += raise * normals_.x[k];
    noisy_.y[m] += raise * normals_.y[k];
    noisy_.z[m] += raise * normals_.z[k];
  }
  for (std::size_t m = 0; m < count; ++m) {
    noisy_.x[m] += means_.positions.x[m];
    noisy_.y[m] += means_.positions.y[m];
    noisy_.z[m] += means_.positions.z[m];
  }
}

void
QuadricData::averageScatter(double radius)
{
  within_ = AlignedArray<float>(means_.size() + kQueryBlock);
  spread_ = AlignedArray<float>(means_.size() + kQueryBlock);
  const auto unit = static_cast<float>(1.0 / (radius * radius));
  const PointsView p = points_.sorted();
  const SortedVectors<float>&c = means_.positions, &n = means_.normals;
  for (std::size_t k = 0; k < p.size; ++k) {
    const std::uint32_t m = means_.mean_of[k];
    const float facing = normals_.x[k] * n.x[m] + normals_.y[k] * n.y[m] + normals_.z[k] * n.z[m];
    const float deviation = std::copysign(heights_[k], heights_[k] * facing) - mean_height_[m];
    const float x = p.x[k] - c.x[m], y = p.y[k] - c.y[m], z = p.z[k] - c.z[m], off = x * n.x[m] + y * n.y[m] + z * n.z[m];
    within_[m] += unit * deviation * deviation;
    spread_[m] += 0.5f * unit * std::max(0.0f, x * x + y * y + z * z - off * off) / means_.weights[m];
  }
}

QuadricSums
QuadricData::sums(const QueryFrames& queries, double radius) const
{
  QuadricSums sums(queries.size());
  const PointsView places = {queries.origin.x.data(), queries.origin.y.data(), queries.origin.z.data(), queries.size()};
  const Neighborhoods near = findNeighborhoods(means_.tree, places, radius, threads_);
  const kernels::Candidates candidates = candidatesOf(near);
  kernels::QuadricMoments all;
  all.queries = queries.origin.vectors();
  all.axis_u = queries.u.vectors();
  all.axis_v = queries.v.vectors();
  all.axis_n = queries.n.vectors();
  all.data = means_.positions.vectors();
  all.noisy = noisy_.vectors();
  all.data_normals = means_.normals.vectors();
  all.data_weight = means_.weights.data();
  all.within = within_.data();
  all.spread = spread_.data();
  all.radius.radius_sq = static_cast<float>(radius * radius);
  all.one_by_radius = static_cast<float>(1.0 / radius);
  all.row = QuadricSums::kQueries;
  parallelBlocks(blockCount(queries.size()), kBlocksPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    kernels::QuadricMoments a = all;
    a.first_output = begin * kQueryBlock;
    a.sums = sums.task(a.first_output);
    kernels::active().quadric_moments(candidates, a, begin, end);
  });
  return sums;
}

} // namespace pcl_gpf
