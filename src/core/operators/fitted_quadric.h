// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace pcl_gpf {

/** A quadric over a plane and how well it agrees with the data; lengths in radii of the ball. */
struct FittedQuadric {
  Eigen::Matrix<double, 6, 1> of; ///< height = of . (1, x, y, x^2, x y, y^2)
  double misfit = 0;              ///< variance of means about it in those that the points of the means explain
  double unevenness = 0;          ///< deviation of normals from an even change in that which is allowed
  double bending = 0;             ///< the larger of its curvatures, by size

  /** \brief Height at a place, the fourth order that curvatures imply set right. */
  double
  height(double x, double y) const;
};

/** \brief Solves the normal equations of QuadricMoments. \param[in] sums one value each `row` places apart
 * \param[in] least_variance of one height, radii squared \return false where the data determine no quadric that can be trusted */
bool
solveQuadric(const float* sums, std::size_t row, double least_variance, FittedQuadric& quadric);

} // namespace pcl_gpf
