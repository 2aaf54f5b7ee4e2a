// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "patches.h"

#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** A point on the surface: where it came to lie, its unit normal, and the input point that gave most to it. */
struct ProjectedPoint {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::uint32_t nearest; ///< in sorted order
  bool found;            ///< false: no input point had weight, nothing was moved
};

/** EAR's bilateral projection onto fixed input points. Const, and safe to share between threads. */
class BilateralProjection {
public:
  /** A point to project, and the normals of the two sides that it may belong to. */
  struct Query {
    std::array<float, 3> position, first, second;
    float longest_move; ///< onto an edge between the two
  };
  /** Memory that a thread uses again for each query. */
  class Scratch {
    friend class BilateralProjection;
    NearbyPoints candidates_;                 ///< of several queries
    std::vector<float> distance_sq_; ///< of each candidate
    NearbyPoints near_;              ///< those within R of one query
    std::vector<float> distance_weight_, weight_;
  };

  /** \param[in] angle sigma_n in radians */
  BilateralProjection(const PointIndex& points, NormalsView normals, double radius, double angle, bool sign_invariant);

  /** Moves each point along the normal, that of the side `first` or of the side `second`, which moves it less.
   * \param[in] queries in an order in which neighbours follow each other, as far as possible */
  void
  project(const std::vector<Query>& queries, Scratch& scratch, ProjectedPoint* results) const;

private:
  struct Side;
  ProjectedPoint
  projectOne(const Query& query, Scratch& scratch) const;
  void
  moveOntoEdge(const Side& a, const Side& c, double longest, std::array<double, 3>& move) const;
  Side
  sumUp(const std::array<float, 3>& b, const std::array<float, 3>& normal, Scratch& scratch) const;

  const PointIndex& points_;
  NormalsView normals_;
  float radius_;
  float distance_falloff_; ///< 4 / R^2
  float angle_falloff_;    ///< 1 / (1 - cos sigma_n)
  double edge_cosine_;     ///< cos sigma_n: sides that turn further meet at an edge
  bool sign_invariant_;
};

} // namespace pcl_gpf
