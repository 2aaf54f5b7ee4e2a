// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  /** Memory that a thread uses again for each query. */
  struct Scratch {
    std::vector<Run> runs;
    std::vector<std::uint32_t> near;
    std::vector<float> distance_weight;
  };

  /** \param[in] angle sigma_n in radians */
  BilateralProjection(const PointIndex& points, NormalsView normals, double radius, double angle, bool sign_invariant);

  /** Moves b along the normal, that of the side `first` or of the side `second`, which moves it less. */
  ProjectedPoint
  project(const std::array<float, 3>& b, const std::array<float, 3>& first, const std::array<float, 3>& second,
          Scratch& scratch) const;

private:
  struct Side;
  Side
  sumUp(const std::array<float, 3>& b, const std::array<float, 3>& normal, const Scratch& scratch) const;

  const PointIndex& points_;
  NormalsView normals_;
  float radius_;
  float distance_falloff_; ///< 4 / R^2
  float angle_falloff_;    ///< 1 / (1 - cos sigma_n)
  bool sign_invariant_;
};

} // namespace pcl_gpf
