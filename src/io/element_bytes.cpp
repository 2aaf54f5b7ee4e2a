// SPDX-License-Identifier: BSD-3-Clause
#include "io/element_bytes.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace pcl_gpf {

namespace {

/** Calls \a function with a value-initialised element of the C++ type behind \a type. */
template <typename Function>
auto withType(FieldType type, Function function) {
  switch (type) {
  case FieldType::Int8:
    return function(std::int8_t{});
  case FieldType::UInt8:
    return function(std::uint8_t{});
  case FieldType::Int16:
    return function(std::int16_t{});
  case FieldType::UInt16:
    return function(std::uint16_t{});
  case FieldType::Int32:
    return function(std::int32_t{});
  case FieldType::UInt32:
    return function(std::uint32_t{});
  case FieldType::Int64:
    return function(std::int64_t{});
  case FieldType::UInt64:
    return function(std::uint64_t{});
  case FieldType::Float32:
    return function(float{});
  case FieldType::Float64:
    break;
  }
  return function(double{});
}

/** Decimal exponent of the first digit that is not zero: tells 1e999 from 1e-999. The token is a valid real. */
long decimalMagnitude(std::string_view token) {
  const std::size_t exponent_mark = token.find_first_of("eE");
  const std::string_view mantissa = token.substr(0, exponent_mark);
  const std::size_t first = mantissa.find_first_of("123456789");
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  long magnitude = first == std::string_view::npos ? 0 : static_cast<long>(point) - static_cast<long>(first);
  if (exponent_mark == std::string_view::npos) return magnitude;
  std::string_view digits = token.substr(exponent_mark + 1);
  if (!digits.empty() && digits[0] == '+') digits.remove_prefix(1);
  int exponent = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  constexpr int kBeyondAnyMantissa = std::numeric_limits<int>::max();
  if (result.ec == std::errc::result_out_of_range)
    exponent = digits[0] == '-' ? -kBeyondAnyMantissa : kBeyondAnyMantissa;
  return magnitude + exponent;
}

template <typename T>
bool parseToken(std::string_view token, T& value) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto result = std::from_chars(token.data(), end, value);
  if (result.ptr != end || token.empty()) return false;
  if (result.ec == std::errc()) return true;
  if constexpr (std::is_floating_point_v<T>) {
    if (result.ec != std::errc::result_out_of_range) return false;
    value = decimalMagnitude(token) > 0 ? std::numeric_limits<T>::infinity() : T{0};
    if (token[0] == '-') value = -value;
    return true;
  }
  return false;
}

template <typename T>
T narrowed(double value) {
  if constexpr (std::is_same_v<T, double>) return value;
  if constexpr (std::is_same_v<T, float>) {
    // 2^128 less half a unit of the last place rounds to 2^128, which no float holds.
    constexpr double kFirstTooLarge = 0x1.ffffffp127;
    if (std::isfinite(value) && std::abs(value) >= kFirstTooLarge) throw std::out_of_range("");
    return static_cast<float>(value);
  }
  if constexpr (std::is_integral_v<T>) {
    const double rounded = std::nearbyint(value);
    // Both limits are powers of two, so exact: [min, max + 1).
    constexpr double kLowest = static_cast<double>(std::numeric_limits<T>::min());
    constexpr double kFirstTooLarge = 2.0 * static_cast<double>(T{1} << (std::numeric_limits<T>::digits - 1));
    if (!(rounded >= kLowest && rounded < kFirstTooLarge)) throw std::out_of_range("");
    return static_cast<T>(rounded);
  }
}

} // namespace

double loadElement(FieldType type, const unsigned char* from) {
  return withType(type, [&](auto element) {
    std::memcpy(&element, from, sizeof element);
    return static_cast<double>(element);
  });
}

void storeElement(FieldType type, double value, unsigned char* to) {
  withType(type, [&](auto element) {
    try {
      element = narrowed<decltype(element)>(value);
    } catch (const std::out_of_range&) {
      char text[kMaxElementText];
      const char* end = std::to_chars(text, text + sizeof text, value).ptr;
      throw std::out_of_range(std::string(static_cast<const char*>(text), end) + " does not fit in a field of type " +
                              nameOf(type));
    }
    std::memcpy(to, &element, sizeof element);
  });
}

bool parseElement(FieldType type, std::string_view token, unsigned char* to) {
  return withType(type, [&](auto element) {
    if (!parseToken(token, element)) return false;
    std::memcpy(to, &element, sizeof element);
    return true;
  });
}

bool parseReal(std::string_view token, double& value) {
  return parseToken(token, value);
}

char* formatElement(FieldType type, const unsigned char* from, char* to) {
  return withType(type, [&](auto element) {
    std::memcpy(&element, from, sizeof element);
    if constexpr (std::is_floating_point_v<decltype(element)>) {
      // "-nan" confuses other readers, and the sign of a NaN means nothing.
      if (std::isnan(element)) return std::copy_n("nan", 3, to);
    }
    return std::to_chars(to, to + kMaxElementText, element).ptr;
  });
}

void swapElements(unsigned char* bytes, std::size_t size, std::size_t count) {
  if (size == 1) return;
  for (std::size_t i = 0; i < count; ++i)
    std::reverse(bytes + i * size, bytes + (i + 1) * size);
}

} // namespace pcl_gpf
