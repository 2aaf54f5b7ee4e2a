// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/** \file
 * \brief Positions in double precision, for measuring; the filters themselves compute in float (views.h).
 */
namespace pcl_gpf {

/** \brief A point or a vector in the units of the cloud. */
using Position = std::array<double, 3>;

inline Position
subtract(const Position& a, const Position& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/** \brief a + factor * b. */
inline Position
addScaled(const Position& a, double factor, const Position& b)
{
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

inline double
dot(const Position& a, const Position& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Position
cross(const Position& a, const Position& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double
length(const Position& a)
{
  return std::hypot(a[0], a[1], a[2]);
}

/** \brief a / |a|; the zero vector stays zero. */
inline Position
normalized(const Position& a)
{
  const double norm = length(a);
  return norm > 0 ? Position{a[0] / norm, a[1] / norm, a[2] / norm} : Position{0, 0, 0};
}

/** \brief Finite, and small enough that squared distances do not overflow: |coordinate| <= 1e150. */
inline bool
isMeasurable(const Position& a)
{
  constexpr double kLargest = 1e150;
  return std::abs(a[0]) <= kLargest && std::abs(a[1]) <= kLargest && std::abs(a[2]) <= kLargest;
}

} // namespace pcl_gpf
