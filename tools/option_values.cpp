// SPDX-License-Identifier: BSD-3-Clause
#include "option_values.h"

#include "console.h"
#include "spelling.h"

#include <pcl_gpf/io/errors.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pcl_gpf {

namespace {

std::string
joined(const std::vector<std::string>& words, const std::string& separator)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : separator) + word;
  return text;
}

/** Limits as people write them: whole numbers of up to 16 digits in full, the rest short. */
std::string
limitText(double value)
{
  if (std::abs(value) < 1e16 && value == std::floor(value))
    return std::to_string(static_cast<long long>(value));
  return shortNumber(value);
}

bool
withinLimits(const OptionSpec& spec, double value)
{
  const bool low = spec.above_least ? value > spec.least : value >= spec.least;
  const bool high = spec.below_most ? value < spec.most : value <= spec.most;
  return low && high;
}

bool
isValid(const OptionSpec& spec, const std::string& value)
{
  switch (spec.kind) {
    case OptionKind::Flag: return true;
    case OptionKind::Text:
    case OptionKind::OptionalText: return !value.empty();
    case OptionKind::Choice: return std::find(spec.choices.begin(), spec.choices.end(), value) != spec.choices.end();
    case OptionKind::Length: return parseLength(value).has_value();
    case OptionKind::Share: return parseShare(value).has_value();
    case OptionKind::Vector: return parseVector(value).has_value();
    case OptionKind::Count: {
      const auto count = parseCount(value);
      return count && withinLimits(spec, static_cast<double>(*count));
    }
    case OptionKind::Number: {
      const auto number = parseNumber(value);
      return number && withinLimits(spec, *number);
    }
  }
  return false;
}

} // namespace

std::optional<std::uint64_t>
parseCount(const std::string& text)
{
  std::uint64_t value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last)
    return std::nullopt;
  return value;
}

std::optional<Share>
parseShare(const std::string& text)
{
  Share share;
  if (!text.empty() && text.back() == '%') {
    const auto percent = parseNumber(text.substr(0, text.size() - 1));
    // Less than one point in 2^31 is no share.
    if (!percent || *percent < 1e-8 || *percent > 100.0)
      return std::nullopt;
    share.ratio = *percent / 100.0;
    return share;
  }
  const auto count = parseCount(text);
  if (!count || *count == 0)
    return std::nullopt;
  share.count = *count;
  return share;
}

std::optional<std::vector<double>>
parseVector(const std::string& text)
{
  std::vector<double> values;
  std::size_t begin = 0;
  while (values.size() < 4) {
    const std::size_t comma = text.find(',', begin);
    const auto value = parseNumber(text.substr(begin, comma - begin));
    if (!value)
      return std::nullopt;
    values.push_back(*value);
    if (comma == std::string::npos)
      break;
    begin = comma + 1;
  }
  if (values.size() != 3)
    return std::nullopt;
  return values;
}

std::string
describeRange(const OptionSpec& spec)
{
  switch (spec.kind) {
    case OptionKind::Flag: return "";
    case OptionKind::Text:
    case OptionKind::OptionalText: return "any text";
    case OptionKind::Choice: return joined(spec.choices, " | ");
    case OptionKind::Length: return "> 0: 0.01 (cloud units), 4x (times spacing), 1% (of diagonal), or auto";
    case OptionKind::Share: return "a count > 0, or a percentage up to 100%";
    case OptionKind::Vector: return "three numbers: 1.5,-2,0";
    case OptionKind::Count:
    case OptionKind::Number: break;
  }
  const std::string whole = spec.kind == OptionKind::Count ? "whole, " : "";
  const bool upper = std::isfinite(spec.most);
  const std::string most = (spec.below_most ? "< " : "<= ") + limitText(spec.most);
  if (!std::isfinite(spec.least))
    return whole + (upper ? most : "finite");
  if (!upper)
    return whole + (spec.above_least ? "> " : ">= ") + limitText(spec.least);
  if (!spec.above_least && !spec.below_most)
    return whole + limitText(spec.least) + " .. " + limitText(spec.most);
  return whole + (spec.above_least ? "> " : ">= ") + limitText(spec.least) + " and " + most;
}

void
checkValue(const OptionSpec& spec, const std::string& value)
{
  if (isValid(spec, value))
    return;
  std::string message = "option '--" + spec.name + "': '" + printable(value) + "' is not allowed; ";
  if (spec.kind == OptionKind::Choice) {
    const std::string nearest = nearestSpelling(value, spec.choices);
    message += nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
  }
  throw UsageError(message + "allowed: " + describeRange(spec));
}

} // namespace pcl_gpf
