// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/errors.h>

#include <charconv>
#include <cmath>
#include <string>

namespace pcl_gpf {

/** \brief Shortest decimal form, independent of the locale. */
inline std::string
toText(double value)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

/** \throws InvalidParameter "name is value; range: range" unless `inside` and the value is finite */
inline void
checkRange(const char* name, double value, bool inside, const char* range)
{
  if (!std::isfinite(value) || !inside)
    throw InvalidParameter(std::string(name) + " is " + toText(value) + "; range: " + range);
}

/** Largest radius in the normalised frame, whose box diagonal is 1: already sees everything with equal weight; keeps squares finite. */
constexpr double kLargestRadius = 1e6;

/** \brief The radius, or kLargestRadius when it is beyond. */
inline double
boundedRadius(double radius)
{
  return radius < kLargestRadius ? radius : kLargestRadius;
}

} // namespace pcl_gpf
