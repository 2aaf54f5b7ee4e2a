// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Values of command line options. All throw std::invalid_argument.
 */
namespace pcl_gpf::benchmark_options {

template <typename T>
T
number(const std::string& text)
{
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw std::invalid_argument("\"" + text + "\" is not a number of the kind wanted");
  return value;
}

/** \brief Parts between commas. */
inline std::vector<std::string>
list(const std::string& text)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/** \brief Sizes of clouds, each at least `least`. */
inline std::vector<std::size_t>
sizes(const std::string& text, std::size_t least = 1)
{
  std::vector<std::size_t> values;
  for (const std::string& part : list(text)) {
    values.push_back(number<std::size_t>(part));
    if (values.back() < least)
      throw std::invalid_argument("a cloud of " + part + " points is too small: at least " + std::to_string(least));
  }
  return values;
}

} // namespace pcl_gpf::benchmark_options
