// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Points to project, neighbours one after another as far as possible, with the normals of the two sides that each may belong to. */
struct ProjectionQueries {
  SortedVectors<float> positions, directions[2];
  std::vector<float> longest_move; ///< onto an edge between the two

  explicit ProjectionQueries(std::size_t count)
  : positions(count), directions{SortedVectors<float>(count), SortedVectors<float>(count)}, longest_move(count)
  {}
  std::size_t size() const { return longest_move.size(); }
};

/** Points on the surface. */
struct ProjectedPoints {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  SoaBuffer positions, normals;
  std::vector<std::uint32_t> nearest; ///< the input point that gave most, in sorted order; kNone: none had weight, nothing was moved

  explicit ProjectedPoints(std::size_t count) : positions(count), normals(count), nearest(count, kNone) {}
};

/** EAR's bilateral projection onto fixed input points. Const, and safe to share between threads. */
class BilateralProjection {
public:
  /** \param[in] normals in sorted order \param[in] angle sigma_n in radians */
  BilateralProjection(const PointIndex& points, NormalsView normals, double radius, double angle, bool sign_invariant);

  /** Moves each point along the normal of the one side or of the other: in a face that which moves it less, beside an edge that which
   * brings it nearer to the edge, and onto the edge itself where both are alike. */
  ProjectedPoints
  project(const ProjectionQueries& queries, std::size_t threads) const;

private:
  struct Side;
  struct Sums;
  Side
  side(const Sums& sums, std::size_t which, std::size_t place) const;
  void
  projectOne(const ProjectionQueries& queries, std::size_t k, const Side& a, const Side& c, ProjectedPoints& to) const;
  bool
  fartherServes(const Side& a, const Side& c) const;
  void
  moveOntoEdge(const Side& a, const Side& c, double longest, std::array<double, 3>& move) const;

  const PointIndex& points_;
  SortedVectors<float> normals_;
  double radius_;
  double angle_falloff_; ///< 1 / (1 - cos sigma_n)
  double edge_cosine_;   ///< cos sigma_n: sides that turn further meet at an edge
  bool sign_invariant_;
};

} // namespace pcl_gpf
