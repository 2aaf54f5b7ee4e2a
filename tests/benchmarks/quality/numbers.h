// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>

namespace pcl_gpf::quality {

/** \brief The number that `text` is, whatever the locale. \throws std::invalid_argument */
inline double
toNumber(const std::string& text)
{
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw std::invalid_argument("\"" + text + "\" is not a number");
  return value;
}

} // namespace pcl_gpf::quality
