// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_cursor.h"

#include <cstring>

#include "io/element_bytes.h"
#include "io/format_readers.h"

namespace pcl_gpf {

PlyCursor::PlyCursor(const LineReader& lines, CloudFormat format)
    : lines_(lines)
    , byte_(lines.position())
    , is_text_(format == CloudFormat::PlyAscii)
    , swap_(format == (kHostIsLittleEndian ? CloudFormat::PlyBigEndian : CloudFormat::PlyLittleEndian)) {}

void PlyCursor::fail(const std::string& promised, const std::string& found) const {
  if (is_text_) lines_.fail(promised, found);
  lines_.source().failAtByte(byte_, promised, found);
}

void PlyCursor::beginRow() {
  if (is_text_ && !lines_.nextFilled(row_)) fail("another row", "the end of the file");
}

void PlyCursor::endRow() {
  std::string_view token;
  if (is_text_ && takeToken(row_, token)) fail("the end of the line after the last property", quoted(token));
}

const unsigned char* PlyCursor::takeBytes(std::uint64_t bytes) {
  const Source& source = lines_.source();
  if (bytes > source.size - byte_)
    fail(std::to_string(bytes) + " more bytes", std::to_string(source.size - byte_) + " until the end of the file");
  const unsigned char* begin = source.data + byte_;
  byte_ += static_cast<std::size_t>(bytes);
  return begin;
}

void PlyCursor::readValue(const PlyProperty& property, unsigned char* to) {
  if (!is_text_) {
    const std::size_t size = sizeOf(property.type);
    std::memcpy(to, takeBytes(size), size);
    if (swap_) swapElements(to, size, 1);
    return;
  }
  std::string_view token;
  if (!takeToken(row_, token)) fail("a value for property " + quoted(property.name), "the end of the line");
  if (!parseElement(property.type, token, to))
    fail(std::string("a number of type ") + nameOf(property.type) + " for property " + quoted(property.name),
         quoted(token));
}

std::uint64_t PlyCursor::readLength(const PlyProperty& property) {
  unsigned char bytes[8];
  readValue({property.name, property.length_type, false, {}}, bytes);
  // Lengths have at most 32 bits, so the double is exact.
  const double length = loadElement(property.length_type, bytes);
  const std::size_t left = is_text_ ? (row_.size() + 1) / 2 : (lines_.source().size - byte_) / sizeOf(property.type);
  if (length < 0 || length > static_cast<double>(left))
    fail("a list length from 0 to the " + std::to_string(left) + " entries that can follow",
         std::to_string(static_cast<std::int64_t>(length)) + " for property " + quoted(property.name));
  return static_cast<std::uint64_t>(length);
}

void PlyCursor::skip(const PlyProperty& property) {
  unsigned char ignored[8];
  const std::uint64_t values = property.is_list ? readLength(property) : 1;
  if (is_text_) {
    for (std::uint64_t k = 0; k < values; ++k)
      readValue(property, ignored);
  } else {
    takeBytes(values * sizeOf(property.type));
  }
}

void PlyCursor::skip(const PlyElement& element) {
  if (!is_text_ && !element.hasLists()) {
    takeBytes(element.count * element.minimumBytes());
    return;
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    beginRow();
    for (const PlyProperty& property : element.properties)
      skip(property);
    endRow();
  }
}

void PlyCursor::reportTrailing(CloudFile& cloud) {
  if (is_text_)
    reportTrailingLines(lines_, cloud);
  else
    reportTrailingBytes(lines_.source().size - byte_, cloud);
}

} // namespace pcl_gpf
