// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Synthetic errors for demonstrations, tests and papers. Lengths are in cloud units; 0 switches a kind off. */
struct SyntheticNoise {
  /** Standard deviation of Gaussian noise on each axis, >= 0. */
  double gaussian = 0.0;
  /** Half width of uniform noise on each axis, >= 0: its standard deviation is 0.577 of it (the noise of the paper's group). */
  double uniform = 0.0;
  /** Standard deviation of Gaussian noise along the normal, >= 0; needs normals. */
  double along_normal = 0.0;
  /** Share of the points, 0 .. 1, replaced by points anywhere in the bounding box enlarged 1.2 times about its centre. */
  double outliers = 0.0;
  /** Same seed, same noise. The kinds draw from streams of their own: switching one on leaves the others as they are. */
  std::uint64_t seed = 1;
};

/** \brief Rows that addNoise() changed. */
struct NoiseReport {
  std::size_t moved = 0;           ///< finite points that any kind of noise was added to
  std::size_t outliers = 0;        ///< points that were replaced: the share of the finite ones, rounded
  std::size_t without_normal = 0;  ///< points that along_normal left alone for want of a finite normal that is not zero
};

/** \brief Adds noise in place; rows that are not finite stay as they are, and the order stays.
 *
 * \param[in,out] points in cloud units
 * \param[in] normals one per point, of any length, or empty
 * \throws InvalidParameter outside the ranges above, or when along_normal has no normals or not one a point
 * \throws UnsuitableData when outliers are asked for and no point is finite
 * \note Repeatable to the last bit on one machine; Gaussian values may differ in the last digit between mathematics libraries.
 */
PCL_GPF_CORE_EXPORT NoiseReport
addNoise(const SyntheticNoise& noise, std::vector<Position>& points, const std::vector<Position>& normals = {});

} // namespace pcl_gpf
