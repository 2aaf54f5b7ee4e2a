// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

std::string message(const std::string& path, const std::string& place, const std::string& promised,
                    const std::string& found) {
  std::string text = printable(path, 4096);
  if (!place.empty()) text += ": " + place;
  return text + ": expected " + promised + ", found " + found;
}

} // namespace

IoError::IoError(IoErrorKind kind, const std::string& path, const std::string& place, const std::string& promised,
                 const std::string& found)
    : std::runtime_error(message(path, place, promised, found))
    , kind_(kind)
    , path_(path)
    , place_(place) {}

std::string printable(const std::string& text, std::size_t limit) {
  static constexpr char kHexDigits[] = "0123456789abcdef";
  std::string result;
  for (std::size_t i = 0; i < text.size() && i < limit; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f) {
      result += "\\x";
      result += kHexDigits[byte >> 4];
      result += kHexDigits[byte & 15];
    } else {
      result += text[i];
    }
  }
  if (text.size() > limit) result += "...";
  return result;
}

} // namespace pcl_gpf
