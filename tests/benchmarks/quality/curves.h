// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>

#include <vector>

/** \file
 * \brief Sharp edges and boundaries of surfaces.
 */
namespace pcl_gpf::quality {

/** \brief A point of a boundary, the direction along it, and the one in the surface's tangent plane that leads off the
 * surface. */
struct BoundarySample {
  Position point, along, outward;
};

/** \brief A curve with exact distances: a straight segment or a circle in a plane of constant z. */
class Curve {
public:
  /** \param[in] outward direction that leads off the surface, when the curve is a boundary */
  static Curve
  segment(const Position& from, const Position& to, const Position& outward = {0, 0, 0});
  /** \param[in] outward at angle 0, as components along the radius and along z */
  static Curve
  circle(const Position& centre, double radius, double outward_along_radius = 0, double outward_up = 0);

  double
  distance(const Position& p) const;
  /** \brief Points at most `step` apart, ends of a segment included. */
  std::vector<BoundarySample>
  samples(double step) const;

private:
  Position start_{0, 0, 0}, end_{0, 0, 0}; ///< of a segment; start_ is the centre of a circle
  double radius_ = 0;                      ///< 0: a segment
  Position outward_{0, 0, 0};
};

/** \brief Smallest distance to any of the curves; infinite without curves. */
double
distanceToCurves(const std::vector<Curve>& curves, const Position& p);

/** \brief Samples of all curves. */
std::vector<BoundarySample>
sampleCurves(const std::vector<Curve>& curves, double step);

} // namespace pcl_gpf::quality
