// SPDX-License-Identifier: BSD-3-Clause
#include "bilateral_projection.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Sums below this are what is left of neighbours that all face elsewhere. */
constexpr double kLeastWeight = 1e-6;
/** A side with less than this share of the other's weight has no input points here. */
constexpr double kLeastShare = 0.3;
/** Of the distances to two planes, for a move onto both: less, and the point lies on one of them already. */
constexpr double kLeastRatio = 0.4;
/** The same, for the farther plane at a sharp edge: less may be rounding. */
constexpr double kLeastOfSharp = 0.05;
constexpr double kDistanceFalloff = 4.0;

double
dotOf(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace

/** Weighted means seen along one candidate normal. */
struct BilateralProjection::Side {
  double weight = 0;
  double offset = 0; ///< of b above the planes
  std::array<double, 3> normal{0, 0, 0};
  std::uint32_t nearest = 0;
};

/** What the kernel gives for the queries of one task. */
struct BilateralProjection::Sums {
  AlignedArray<float> weight[2], offset[2];
  AlignedArray<std::uint32_t> nearest[2];
  SortedVectors<float> normal[2];

  explicit Sums(std::size_t count)
  {
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      weight[k].assign(count);
      offset[k].assign(count);
      nearest[k].assign(count);
      normal[k] = SortedVectors<float>(count);
    }
  }
};

BilateralProjection::BilateralProjection(const PointIndex& points, NormalsView normals, double radius, double angle, bool sign_invariant)
: points_(points)
, normals_(gather<float>(normals, {}, {}, 0.0f))
, radius_(radius)
, angle_falloff_(1.0 / (1.0 - std::cos(angle)))
, edge_cosine_(std::cos(angle))
, sign_invariant_(sign_invariant)
{}

BilateralProjection::Side
BilateralProjection::side(const Sums& sums, std::size_t which, std::size_t place) const
{
  Side side;
  const SortedVectors<float>& normal = sums.normal[which];
  side.normal = {normal.x[place], normal.y[place], normal.z[place]};
  const double length = std::sqrt(side.normal[0] * side.normal[0] + side.normal[1] * side.normal[1] + side.normal[2] * side.normal[2]);
  if (!(length > kLeastWeight))
    return side;
  side.weight = sums.weight[which][place];
  side.offset = sums.offset[which][place] / side.weight;
  for (double& n : side.normal)
    n /= length;
  side.nearest = sums.nearest[which][place];
  return side;
}

void
BilateralProjection::projectOne(const ProjectionQueries& queries, std::size_t k, const Side& a, const Side& c, ProjectedPoints& to) const
{
  const std::array<double, 3> b{queries.positions.x[k], queries.positions.y[k], queries.positions.z[k]};
  std::array<double, 3> move{}, normal{queries.directions[0].x[k], queries.directions[0].y[k], queries.directions[0].z[k]};
  // Near a corner a face that ends there must not go on as a sheet of new points that gave each other their normals.
  const double least_weight = std::max(kLeastWeight, kLeastShare * std::max(a.weight, c.weight));
  const bool a_counts = a.weight > least_weight, c_counts = c.weight > least_weight;
  if (a_counts || c_counts) {
    const bool a_is_nearer = std::abs(a.offset) <= std::abs(c.offset);
    const bool take_a = a_counts && (!c_counts || a_is_nearer != fartherServes(a, c));
    const Side& side = take_a ? a : c;
    normal = side.normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
      move[axis] = -side.offset * side.normal[axis];
    if (a_counts && c_counts)
      moveOntoEdge(a, c, queries.longest_move[k], move);
    to.nearest[k] = side.nearest;
  }
  AlignedArray<float>* positions[3] = {&to.positions.x, &to.positions.y, &to.positions.z};
  AlignedArray<float>* normals[3] = {&to.normals.x, &to.normals.y, &to.normals.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    (*positions[axis])[k] = static_cast<float>(b[axis] + move[axis]);
    (*normals[axis])[k] = static_cast<float>(normal[axis]);
  }
}

/** Whether the foot of b on the plane that lies farther away is a point of that face. Half-way between v on one face and t on the other
 * it is the foot that lies nearer to the edge; where faces meet at more than 90 degrees it may lie beyond the edge, in the air. */
bool
BilateralProjection::fartherServes(const Side& a, const Side& c) const
{
  const double cosine = dotOf(a.normal, c.normal);
  if ((sign_invariant_ ? std::abs(cosine) : cosine) > edge_cosine_)
    return false; // one face
  const double lesser = std::min(std::abs(a.offset), std::abs(c.offset)), larger = std::max(std::abs(a.offset), std::abs(c.offset));
  const double sides = a.offset * c.offset; // > 0: b lies above both planes, or below both
  if (!sign_invariant_)
    return sides > 0.0 && lesser > cosine * larger;
  // Without signs: normals that agree with the sides are those of an edge of more than 90 degrees, others of a sharper one.
  return lesser > std::max(kLeastOfSharp, sides * cosine > 0.0 ? std::abs(cosine) : 0.0) * larger;
}

/** The shortest move onto both planes, if they meet at an angle and near enough. */
void
BilateralProjection::moveOntoEdge(const Side& a, const Side& c, double longest, std::array<double, 3>& move) const
{
  const double cosine = dotOf(a.normal, c.normal);
  if ((sign_invariant_ ? std::abs(cosine) : cosine) > edge_cosine_ || !(cosine * cosine < 0.97))
    return;
  const double lesser = std::min(std::abs(a.offset), std::abs(c.offset)), larger = std::max(std::abs(a.offset), std::abs(c.offset));
  if (lesser < kLeastRatio * larger)
    return;
  const double scale = 1.0 / (1.0 - cosine * cosine);
  const double along_a = (a.offset - cosine * c.offset) * scale, along_c = (c.offset - cosine * a.offset) * scale;
  std::array<double, 3> onto{};
  double length_sq = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    onto[axis] = -(along_a * a.normal[axis] + along_c * c.normal[axis]);
    length_sq += onto[axis] * onto[axis];
  }
  if (length_sq <= longest * longest)
    move = onto;
}

ProjectedPoints
BilateralProjection::project(const ProjectionQueries& queries, std::size_t threads) const
{
  const std::size_t count = queries.size();
  ProjectedPoints projected(count);
  const PointsView positions{queries.positions.x.data(), queries.positions.y.data(), queries.positions.z.data(), count};
  const PointsView data = points_.sorted();
  const Neighborhoods neighborhoods = findNeighborhoods(points_.tree(), positions, radius_, threads);
  const kernels::Candidates candidates = candidatesOf(neighborhoods);
  parallelBlocks(blockCount(count), kBlocksPerTask, threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin * kQueryBlock, last = std::min(count, end * kQueryBlock);
    Sums sums((end - begin) * kQueryBlock);
    kernels::SideSums a;
    a.queries = queries.positions.vectors();
    a.data = {data.x, data.y, data.z};
    a.data_normals = normals_.vectors();
    a.radius_sq = static_cast<float>(radius_ * radius_);
    a.falloff = static_cast<float>(kDistanceFalloff);
    a.angle_falloff = static_cast<float>(angle_falloff_);
    a.sign_invariant = sign_invariant_;
    a.first_output = first;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      a.directions[k] = queries.directions[k].vectors();
      a.weight[k] = sums.weight[k].data();
      a.offset[k] = sums.offset[k].data();
      a.nearest[k] = sums.nearest[k].data();
      a.normal[k] = sums.normal[k].vectors();
    }
    kernels::active().side_sums(candidates, a, begin, end);
    for (std::size_t k = first; k < last; ++k)
      projectOne(queries, k, side(sums, 0, k - first), side(sums, 1, k - first), projected);
  });
  return projected;
}

} // namespace pcl_gpf
