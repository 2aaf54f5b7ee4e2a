// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/gap_filling.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "filtered_cloud_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_gpf {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/** Half width of a strip, and largest height of its points above the tangent plane, as shares of its length. */
constexpr float kHalfWidth = 0.25f, kHeight = 0.25f;
/** The plane of the other face is the mean over points not much further away than the nearest of them. */
constexpr float kPatch = 0.2f;
/** How far from an edge its face is looked for, as a share of the length, and largest share of the face beyond it: none where three
 * edges meet and the face goes round the corner. */
constexpr double kBeside = 0.75, kMostBeyond = 0.2;
/** Points that stay on the edge, and shortest move, in spacings. */
constexpr double kStay = 1.0, kShortest = 0.5;
/** Furthest that the nearest point of the other face may be beyond the edge, in spacings: else the surface is curved, not creased. */
constexpr double kCrease = 3.0;
constexpr std::size_t kFewestInStrip = 8;

/** A datum in the ball about a point, relative to it. */
struct Neighbor {
  Eigen::Vector3f offset, normal;
  std::uint32_t place; ///< among the sorted points
};

/** Points of the ball about one point: those of its own face, and the others. */
struct Ball {
  std::vector<Neighbor> own, other;
};

/** The edge that the point's face has with another. */
struct Edge {
  Eigen::Vector3f inward = Eigen::Vector3f::Zero(); ///< unit vector in the tangent plane, away from the edge
  double distance = 0;                              ///< of the point from the edge, negative beyond it
  double nearest_other = 0;                         ///< distance of the nearest point of the other face
  bool found = false;
};

class GapFiller {
public:
  GapFiller(const GapFillingParameters& p, PointsView positions, NormalsView normals)
  : length_(boundedRadius(p.radius))
  , reach_(static_cast<float>(length_ * std::sqrt(1.0 + kHalfWidth * kHalfWidth)))
  , cosine_(static_cast<float>(std::cos(p.angle * kDegree)))
  , half_cosine_(static_cast<float>(std::cos(0.5 * p.angle * kDegree)))
  , cloud_(positions, normals, 0.5 * length_, p.spacing, p.number_of_threads)
  , near_(cloud_.neighborhoods(reach_))
  {}

  /** \return whether all data near a block of points face one way */
  bool
  onOneFace(std::size_t block) const;
  Eigen::Vector3f
  moveOf(std::size_t k, Ball& ball) const;
  const FilteredCloudIndex& cloud() const { return cloud_; }

private:
  Eigen::Vector3f
  normalOf(std::size_t k) const
  {
    return {cloud_.normals.x[k], cloud_.normals.y[k], cloud_.normals.z[k]};
  }
  template <typename F>
  void
  forCandidates(std::size_t block, const F& f) const
  {
    for (std::size_t r = near_.run_offsets[block]; r < near_.run_offsets[block + 1]; ++r)
      for (std::uint32_t j = near_.runs[r].begin; j < near_.runs[r].end; ++j)
        f(j, Eigen::Vector3f(cloud_.data_normals.x[j], cloud_.data_normals.y[j], cloud_.data_normals.z[j]));
  }
  void
  fill(std::size_t k, Ball& ball) const;
  bool
  turnInward(const Eigen::Vector3f& normal, const Ball& ball, Edge& edge) const;
  Edge
  edgeOf(const Eigen::Vector3f& normal, const Ball& ball) const;
  double
  placeInStrip(std::size_t k, const Eigen::Vector3f& normal, const Edge& edge, const Ball& ball, double& spacing) const;

  double length_;
  float reach_, cosine_, half_cosine_;
  FilteredCloudIndex cloud_;
  Neighborhoods near_;
};

bool
GapFiller::onOneFace(std::size_t block) const
{
  const Eigen::Vector3f first = normalOf(block * kQueryBlock);
  const std::size_t end = std::min(cloud_.points.size(), (block + 1) * kQueryBlock);
  bool one = true;
  for (std::size_t k = block * kQueryBlock; k < end; ++k)
    one = one && std::abs(normalOf(k).dot(first)) > half_cosine_;
  if (one)
    forCandidates(block, [&](std::uint32_t, const Eigen::Vector3f& normal) { one &= std::abs(normal.dot(first)) > half_cosine_; });
  return one;
}

void
GapFiller::fill(std::size_t k, Ball& ball) const
{
  ball.own.clear();
  ball.other.clear();
  const PointsView points = cloud_.points.sorted();
  const Eigen::Vector3f own = normalOf(k);
  forCandidates(k / kQueryBlock, [&](std::uint32_t j, const Eigen::Vector3f& normal) {
    const Eigen::Vector3f offset(cloud_.data.x[j] - points.x[k], cloud_.data.y[j] - points.y[k], cloud_.data.z[j] - points.z[k]);
    if (offset.squaredNorm() < reach_ * reach_)
      (std::abs(normal.dot(own)) > cosine_ ? ball.own : ball.other)
          .push_back({offset, normal, static_cast<std::uint32_t>(j * cloud_.stride)});
  });
}

/** Turns the direction to where the own face is beside the point. \return false where the face lies on both sides */
bool
GapFiller::turnInward(const Eigen::Vector3f& normal, const Ball& ball, Edge& edge) const
{
  const Eigen::Vector3f along_edge = normal.cross(edge.inward);
  const double half_width = kHalfWidth * length_;
  double one_side = 0, other_side = 0;
  for (const Neighbor& n : ball.own) {
    const double distance = edge.distance + static_cast<double>(n.offset.dot(edge.inward));
    const double weight = std::max(0.0, 1.0 - std::abs(static_cast<double>(n.offset.dot(along_edge))) / half_width);
    if (std::abs(distance) < kBeside * length_)
      (distance > 0 ? one_side : other_side) += weight * std::abs(distance);
  }
  if (one_side < other_side) {
    edge.inward = -edge.inward;
    edge.distance = -edge.distance;
    std::swap(one_side, other_side);
  }
  return other_side < kMostBeyond * one_side;
}

/** The line in which the tangent plane meets the mean plane of the nearest other face. */
Edge
GapFiller::edgeOf(const Eigen::Vector3f& normal, const Ball& ball) const
{
  Edge edge;
  const auto nearest = std::min_element(ball.other.begin(), ball.other.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.offset.squaredNorm() < b.offset.squaredNorm();
  });
  if (nearest == ball.other.end())
    return edge;
  edge.nearest_other = nearest->offset.norm();
  const float patch = static_cast<float>(edge.nearest_other) + kPatch * static_cast<float>(length_);
  Eigen::Vector3f through = Eigen::Vector3f::Zero(), direction = Eigen::Vector3f::Zero();
  float count = 0;
  for (const Neighbor& n : ball.other) {
    const float cosine = n.normal.dot(nearest->normal);
    if (!(std::abs(cosine) > cosine_) || !(n.offset.squaredNorm() < patch * patch))
      continue;
    through += n.offset;
    direction += cosine < 0 ? Eigen::Vector3f(-n.normal) : n.normal;
    count += 1;
  }
  direction.normalize();
  const Eigen::Vector3f across = direction - direction.dot(normal) * normal;
  const float sine = across.norm();
  if (!(sine > 0.1f))
    return edge;
  edge.inward = across / sine;
  edge.distance = -static_cast<double>(through.dot(direction) / count / sine);
  edge.found = turnInward(normal, ball, edge);
  return edge;
}

/** Distance from the edge at which the point would be if the points of the strip lay evenly. \param[out] spacing in the strip */
double
GapFiller::placeInStrip(std::size_t k, const Eigen::Vector3f& normal, const Edge& edge, const Ball& ball, double& spacing) const
{
  const Eigen::Vector3f along_edge = normal.cross(edge.inward);
  const float half_width = kHalfWidth * static_cast<float>(length_), highest = kHeight * static_cast<float>(length_);
  double all = 0, before = 0, furthest = 0;
  std::size_t count = 0;
  for (const Neighbor& n : ball.own) {
    const float aside = std::abs(n.offset.dot(along_edge)), step = n.offset.dot(edge.inward);
    const double distance = edge.distance + static_cast<double>(step);
    if (!(aside < half_width) || !(std::abs(n.offset.dot(normal)) < highest) || !(distance < length_) || !(distance > -0.25 * length_))
      continue;
    const double weight = 1.0 - static_cast<double>(aside / half_width);
    all += weight;
    before += step < 0 || (step == 0 && n.place < k) ? weight : step == 0 && n.place == k ? 0.5 * weight : 0.0;
    furthest = std::max(furthest, distance);
    ++count;
  }
  if (count < kFewestInStrip || !(all > 0))
    return 0;
  spacing = std::sqrt(furthest * static_cast<double>(half_width) / all / static_cast<double>(cloud_.stride));
  const double stay = kStay * spacing, place = furthest * before / all;
  return (place - stay) * furthest / std::max(furthest - stay, spacing);
}

Eigen::Vector3f
GapFiller::moveOf(std::size_t k, Ball& ball) const
{
  const Eigen::Vector3f normal = normalOf(k), none = Eigen::Vector3f::Zero();
  fill(k, ball);
  const Edge edge = edgeOf(normal, ball);
  if (!edge.found || edge.distance > 0.5 * length_)
    return none;
  double spacing = 0;
  const double place = placeInStrip(k, normal, edge, ball, spacing);
  if (!(place - edge.distance > kShortest * spacing) || edge.nearest_other > std::abs(edge.distance) + kCrease * spacing)
    return none;
  return static_cast<float>(place - edge.distance) * edge.inward;
}

} // namespace

SoaBuffer
movesIntoGaps(const GapFillingParameters& p, PointsView positions, NormalsView normals)
{
  checkRange("radius", p.radius, p.radius > 0.0, "> 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("angle", p.angle, p.angle > 0.0 && p.angle < 90.0, "> 0 and < 90");
  SoaBuffer moves(positions.size);
  if (positions.size == 0)
    return moves;
  const GapFiller filler(p, positions, normals);
  const FilteredCloudIndex& cloud = filler.cloud();
  parallelBlocks(blockCount(positions.size), kBlocksPerTask, cloud.threads, [&](std::size_t begin, std::size_t end) {
    Ball ball;
    for (std::size_t block = begin; block < end; ++block) {
      if (filler.onOneFace(block))
        continue;
      for (std::size_t k = block * kQueryBlock; k < std::min(positions.size, (block + 1) * kQueryBlock); ++k) {
        const Eigen::Vector3f move = filler.moveOf(k, ball);
        const std::size_t to = cloud.points.order()[k];
        moves.x[to] = move.x();
        moves.y[to] = move.y();
        moves.z[to] = move.z();
      }
    }
  });
  return moves;
}

} // namespace pcl_gpf
