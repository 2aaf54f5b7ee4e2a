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

} // namespace pcl_gpf
