// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief A point relative to another. */
using Offset = std::array<double, 3>;

/** \brief A height field of second degree over the plane of some points. */
struct SurfacePatch {
  double deviation = 0.0;              ///< standard deviation of the points about it, infinite: no fit; 0: all at one place
  double kurtosis = 0.0;               ///< of their heights: 3 on a normal distribution, about 2.5 when it is trimmed, 1.8 on an even one
  double trimmed = 0.0;                ///< share of the points in the cylinder that are further away than the trim
  std::size_t count = 0;               ///< points that these are of
  Offset foot{0.0, 0.0, 0.0};          ///< where the normal through the origin meets it
  bool narrow = true;                  ///< the points follow a line: the plane may turn about it
  double reach = 0.0;                  ///< radius of the cylinder that its points are in
};

/** In standard deviations. Wider takes in second sheets and outliers; narrower tells Gaussian from uniform noise too little. */
constexpr double kPatchTrim = 2.25;

/** \brief Fits a patch to points within `radius` of the origin, which is near the surface.
 *
 * `noise`, the deviation that is expected, decides what belongs to the surface: points within kPatchTrim of it; infinite: all. Only
 * a cylinder about the normal counts in which the ball cuts no such point off, so that the ball's shape is not taken for the noise's.
 * `heights`, if given, gets the heights of all points in the cylinder about the patch, in units of `noise`, no further than `height` of
 * it; then the cylinder is one in which the ball cuts off none of these.
 */
SurfacePatch
fitSurfacePatch(const std::vector<Offset>& points, double radius, double noise, double height = kPatchTrim,
                std::vector<float>* heights = nullptr);

} // namespace pcl_gpf
