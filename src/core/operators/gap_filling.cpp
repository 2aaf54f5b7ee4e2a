// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/gap_filling.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "edge_strip.h"
#include "face_edge.h"
#include "filtered_cloud_index.h"
#include "patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_gpf {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::size_t kPointsPerTask = 2048;
/** Shares of the length of a strip: its half width, the largest height of its points above the tangent plane, how far beyond the edge
 * it begins, how far from the edge points are moved, and the width of patches whose points share a strip. */
constexpr double kHalfWidth = 0.25, kHeight = 0.25, kBeyond = 0.25, kFurthest = 0.5, kPatchWidth = 0.125;
/** Shortest move, in spacings. */
constexpr double kShortest = 0.5;
/** Furthest that the nearest point of the other face may be beyond the edge, in spacings: else the surface is curved, not creased. */
constexpr double kCrease = 3.0;
constexpr std::size_t kFewestInStrip = 8;
/** Directions that the points of a patch may face; more are no faces. */
constexpr std::size_t kMostGroups = 16;
/** Radius, as a share of the length, of the ball that holds kMostData at most: twice as many in the ball about a strip. */
constexpr double kDense = 0.7;

using Vector = Eigen::Vector3f;

Eigen::Map<const Vector>
asVector(const std::array<float, 3>& values)
{
  return Eigen::Map<const Vector>(values.data());
}

class GapFiller {
public:
  GapFiller(const GapFillingParameters& p, PointsView positions, NormalsView normals)
  : length_(boundedRadius(p.radius))
  , reach_(static_cast<float>(length_ * std::sqrt(1.0 + kHalfWidth * kHalfWidth)))
  , cosine_(static_cast<float>(std::cos(p.angle * kDegree)))
  , half_cosine_(static_cast<float>(std::cos(0.5 * p.angle * kDegree)))
  , cloud_(positions, normals, kDense * length_, p.spacing, p.number_of_threads)
  {}

  SoaBuffer
  moves() const;

private:
  /** Memory that a task uses again. */
  struct Scratch {
    std::vector<Run> runs;
    std::vector<FacePoint> data, points, group;
    FaceView view;
    EdgeStrip strip;
  };

  void
  takePoints(std::size_t first, std::size_t last, std::vector<FacePoint>& points) const;
  void
  collectData(const FloatBox& box, Scratch& scratch) const;
  void
  takeGroup(Scratch& scratch) const;
  void
  lookAround(Scratch& scratch) const;
  bool
  layStrip(const FaceEdge& edge, const FaceView& view, EdgeStrip& strip) const;
  void
  moveGroup(Scratch& scratch, SoaBuffer& moves) const;

  double length_;
  float reach_, cosine_, half_cosine_;
  FilteredCloudIndex cloud_;
};

void
GapFiller::takePoints(std::size_t first, std::size_t last, std::vector<FacePoint>& points) const
{
  const PointsView p = cloud_.points.sorted();
  points.clear();
  for (std::size_t k = first; k < last; ++k)
    points.push_back({{p.x[k], p.y[k], p.z[k]}, {cloud_.normals.x[k], cloud_.normals.y[k], cloud_.normals.z[k]}, static_cast<std::uint32_t>(k)});
}

/** All data near a box. */
void
GapFiller::collectData(const FloatBox& box, Scratch& scratch) const
{
  scratch.runs.clear();
  scratch.data.clear();
  cloud_.tree.collectRuns(box, reach_, scratch.runs);
  for (const Run run : scratch.runs)
    for (std::uint32_t j = run.begin; j < run.end; ++j)
      scratch.data.push_back({{cloud_.data.x[j], cloud_.data.y[j], cloud_.data.z[j]},
                              {cloud_.data_normals.x[j], cloud_.data_normals.y[j], cloud_.data_normals.z[j]},
                              static_cast<std::uint32_t>(j * cloud_.stride)});
}

/** Those of the points that face as the first does. */
void
GapFiller::takeGroup(Scratch& scratch) const
{
  const Vector first = asVector(scratch.points.front().normal);
  const auto others = std::stable_partition(scratch.points.begin(), scratch.points.end(),
                                            [&](const FacePoint& p) { return std::abs(asVector(p.normal).dot(first)) > half_cosine_; });
  scratch.group.assign(scratch.points.begin(), others);
  if (others == scratch.points.begin()) // no direction at all
    scratch.points.erase(others);
  else
    scratch.points.erase(scratch.points.begin(), others);
  Eigen::Map<Vector> center(scratch.view.center.data()), normal(scratch.view.normal.data());
  center.setZero();
  normal.setZero();
  for (const FacePoint& p : scratch.group) {
    const Vector own = asVector(p.normal);
    center += asVector(p.position);
    normal += own.dot(first) < 0 ? Vector(-own) : own;
  }
  center /= static_cast<float>(std::max<std::size_t>(1, scratch.group.size()));
  normal.normalize();
}

/** What lies about the group. */
void
GapFiller::lookAround(Scratch& scratch) const
{
  FaceView& view = scratch.view;
  view.own.clear();
  view.other.clear();
  for (const FacePoint& p : scratch.data) {
    const Vector offset = asVector(p.position) - asVector(view.center);
    if (offset.squaredNorm() < reach_ * reach_)
      (std::abs(asVector(p.normal).dot(asVector(view.normal))) > cosine_ ? view.own : view.other)
          .push_back({{offset.x(), offset.y(), offset.z()}, p.normal, p.place});
  }
}

/** \return false where there are too few points */
bool
GapFiller::layStrip(const FaceEdge& edge, const FaceView& view, EdgeStrip& strip) const
{
  const Vector normal = asVector(view.normal), along_edge = normal.cross(asVector(edge.inward));
  const double half_width = kHalfWidth * length_;
  strip.points.clear();
  for (const FacePoint& p : view.own) {
    const double weight = 1.0 - std::abs(static_cast<double>(asVector(p.position).dot(along_edge))) / half_width;
    const double distance = edge.distanceOf(p.position), height = static_cast<double>(asVector(p.position).dot(normal));
    if (weight > 0 && distance < length_ && distance > -kBeyond * length_ && std::abs(height) < kHeight * length_)
      strip.points.push_back({distance, weight, p.place});
  }
  if (strip.points.size() < kFewestInStrip)
    return false;
  std::sort(strip.points.begin(), strip.points.end());
  double sum = 0;
  for (StripPoint& p : strip.points)
    p.weight = sum += p.weight;
  strip.length = std::max(0.0, strip.points.back().distance);
  strip.spacing = std::sqrt(strip.length * half_width / sum / static_cast<double>(cloud_.stride));
  return strip.spacing > 0;
}

void
GapFiller::moveGroup(Scratch& scratch, SoaBuffer& moves) const
{
  lookAround(scratch);
  const FaceEdge edge = nearestEdge(scratch.view, reach_, cosine_);
  if (!edge.found || edge.distance > kFurthest * length_ || !layStrip(edge, scratch.view, scratch.strip))
    return;
  const double spacing = scratch.strip.spacing;
  if (edge.nearest_other > std::abs(edge.distance) + kCrease * spacing)
    return;
  for (const FacePoint& p : scratch.group) {
    const Vector offset = asVector(p.position) - asVector(scratch.view.center), normal = asVector(p.normal), across = asVector(edge.inward);
    const double distance = edge.distanceOf({offset.x(), offset.y(), offset.z()});
    const double move = scratch.strip.placeOf({distance, 0.0, p.place}) - distance;
    if (!(move > kShortest * spacing))
      continue;
    const Vector inward = (across - across.dot(normal) * normal).normalized() * static_cast<float>(move);
    const std::size_t to = cloud_.points.order()[p.place];
    moves.x[to] = inward.x();
    moves.y[to] = inward.y();
    moves.z[to] = inward.z();
  }
}

SoaBuffer
GapFiller::moves() const
{
  const std::size_t size = cloud_.points.size();
  SoaBuffer moves(size);
  const auto position = [p = cloud_.points.sorted()](std::size_t k) { return std::array<float, 3>{p.x[k], p.y[k], p.z[k]}; };
  parallelBlocks(size, kPointsPerTask, cloud_.threads, [&](std::size_t begin, std::size_t end) {
    Scratch scratch;
    forPatches(begin, end, static_cast<float>(kPatchWidth * length_), position, [&](std::size_t first, std::size_t last, const FloatBox& box) {
      collectData(box, scratch);
      takePoints(first, last, scratch.points);
      for (std::size_t group = 0; group < kMostGroups && !scratch.points.empty(); ++group) {
        takeGroup(scratch);
        moveGroup(scratch, moves);
      }
    });
  });
  return moves;
}

} // namespace

SoaBuffer
movesIntoGaps(const GapFillingParameters& p, PointsView positions, NormalsView normals)
{
  checkRange("radius", p.radius, p.radius > 0.0, "> 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("angle", p.angle, p.angle > 0.0 && p.angle < 90.0, "> 0 and < 90");
  if (positions.size == 0)
    return {};
  return GapFiller(p, positions, normals).moves();
}

} // namespace pcl_gpf
