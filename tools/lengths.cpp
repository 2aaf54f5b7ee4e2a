// SPDX-License-Identifier: BSD-3-Clause
#include "lengths.h"

#include <charconv>
#include <cmath>

namespace pcl_gpf {

namespace {

// Squares and cubes of coordinates of this size still fit in a double.
constexpr double kLeastLength = 1e-60;
constexpr double kMostLength = 1e60;

} // namespace

double
Length::resolve(const CloudScale& scale) const
{
  switch (unit) {
    case Unit::Cloud: return value;
    case Unit::Spacing: return value * scale.spacing;
    case Unit::Diagonal: return value / 100.0 * scale.diagonal;
    case Unit::Auto: break;
  }
  return 0.0;
}

std::optional<double>
parseNumber(const std::string& text)
{
  double value = 0.0;
  const char* first = text.data();
  const char* last = first + text.size();
  // from_chars does not know a leading plus.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<Length>
parseLength(const std::string& text)
{
  if (text == "auto")
    return Length{};
  Length length;
  length.unit = Length::Unit::Cloud;
  std::string digits = text;
  if (!text.empty() && (text.back() == 'x' || text.back() == '%')) {
    length.unit = text.back() == 'x' ? Length::Unit::Spacing : Length::Unit::Diagonal;
    digits.pop_back();
  }
  const std::optional<double> value = parseNumber(digits);
  if (!value || *value < kLeastLength || *value > kMostLength)
    return std::nullopt;
  length.value = *value;
  return length;
}

} // namespace pcl_gpf
