// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "io/element_bytes.h"
#include "io/format_readers.h"
#include "io/lzf.h"
#include "io/pcd_header.h"
#include "io/row_map.h"

namespace pcl_gpf {

namespace {

/** The cloud's fields are the file's without padding: `_` only aligns the writer's structures and holds no data, so it
 * is neither kept nor ever written. Returns how rows of the file become rows of the cloud. */
RowMap dropPadding(const PcdHeader& header, CloudFile& cloud) {
  RowMap map;
  std::size_t offset = 0;
  for (const CloudField& column : header.columns) {
    if (column.name == "_") continue;
    const std::size_t bytes = sizeOf(column.type) * column.count;
    cloud.fields.push_back({column.name, column.type, column.count, offset});
    map.add(column.offset, offset, bytes);
    offset += bytes;
  }
  return map;
}

void readAsciiRow(LineReader& lines, std::string_view line, const PcdHeader& header, unsigned char* row) {
  std::string_view token;
  unsigned char ignored[8];
  for (const CloudField& column : header.columns) {
    const bool is_padding = column.name == "_";
    for (std::uint32_t k = 0; k < column.count; ++k) {
      if (!takeToken(line, token)) lines.fail("a value for field " + quoted(column.name), "the end of the line");
      unsigned char* to = is_padding ? ignored : row;
      if (!parseElement(column.type, token, to))
        lines.fail(std::string("a number of type ") + nameOf(column.type) + " for field " + quoted(column.name),
                   quoted(token));
      if (!is_padding) row += sizeOf(column.type);
    }
  }
  if (takeToken(line, token)) lines.fail("the end of the line after the last field", quoted(token));
}

void readAscii(LineReader& lines, const PcdHeader& header, CloudFile& cloud) {
  std::uint64_t columns = 0;
  for (const CloudField& column : header.columns)
    columns += column.count;
  requireBytes(lines.source(), lines.position(), cloud.size(), 2 * columns - 1, lines.bytesLeft());
  const std::size_t step = cloud.pointStep();
  cloud.data.resize(cloud.size() * step);
  std::string_view line;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!lines.nextFilled(line))
      lines.fail(std::to_string(cloud.size()) + " points", "the end of the file after " + std::to_string(i));
    readAsciiRow(lines, line, header, cloud.data.data() + i * step);
  }
  reportTrailingLines(lines, cloud);
}

/** PCD files are little endian; on another machine the kept fields are turned round. */
void fromLittleEndian(CloudFile& cloud) {
  if (kHostIsLittleEndian) return;
  const std::size_t step = cloud.pointStep();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (const CloudField& field : cloud.fields)
      swapElements(cloud.data.data() + i * step + field.offset, sizeOf(field.type), field.count);
}

void readBinary(const LineReader& lines, const PcdHeader& header, const RowMap& map, CloudFile& cloud) {
  const Source& source = lines.source();
  requireBytes(source, lines.position(), cloud.size(), header.step, lines.bytesLeft());
  cloud.data.resize(cloud.size() * cloud.pointStep());
  map.apply(source.data + lines.position(), header.step, cloud.data.data(), cloud.pointStep(), cloud.size());
  fromLittleEndian(cloud);
  reportTrailingBytes(lines.bytesLeft() - cloud.size() * header.step, cloud);
}

std::size_t littleEndian32(const unsigned char* bytes) {
  return static_cast<std::size_t>(bytes[0]) | static_cast<std::size_t>(bytes[1]) << 8 |
         static_cast<std::size_t>(bytes[2]) << 16 | static_cast<std::size_t>(bytes[3]) << 24;
}

/** Some versions of PCL round a compressed file up towards a whole page with zeros; that is nothing to warn of. */
bool isPagePadding(const unsigned char* bytes, std::size_t size) {
  constexpr std::size_t kPage = 4096;
  return size < kPage && std::all_of(bytes, bytes + size, [](unsigned char byte) { return byte == 0; });
}

/** Unpacks the body: all elements of the first field, then all of the second ... */
std::vector<unsigned char> unpackedBody(const LineReader& lines, const PcdHeader& header, CloudFile& cloud) {
  const Source& source = lines.source();
  const std::size_t body = lines.position();
  constexpr std::size_t kSizes = 8;
  if (lines.bytesLeft() < kSizes)
    source.failAtByte(body, "the two sizes of a compressed body", std::to_string(lines.bytesLeft()) + " bytes");
  const std::size_t packed = littleEndian32(source.data + body);
  const std::size_t unpacked = littleEndian32(source.data + body + 4);
  const std::size_t left = lines.bytesLeft() - kSizes;
  // At most 2^31 points of at most 2^31 bytes, so the product fits in 64 bits.
  const std::size_t promised = cloud.size() * header.step;
  if (unpacked != promised)
    source.failAtByte(body + 4, "an uncompressed size of " + std::to_string(promised) + " bytes, POINTS x SIZE",
                      std::to_string(unpacked));
  if (packed > left)
    source.failAtByte(body, "a compressed size within the " + std::to_string(left) + " bytes that follow",
                      std::to_string(packed));
  if (unpacked > lzfCapacity(packed))
    source.failAtByte(body + 4,
                      "at most " + std::to_string(lzfCapacity(packed)) + " bytes from " + std::to_string(packed),
                      std::to_string(unpacked));
  std::vector<unsigned char> columns(unpacked);
  if (!lzfDecompress(source.data + body + kSizes, packed, columns.data(), unpacked))
    source.failAtByte(body + kSizes, "LZF data that unpack to " + std::to_string(unpacked) + " bytes",
                      "a broken stream");
  const unsigned char* end = source.data + body + kSizes + packed;
  if (!isPagePadding(end, left - packed)) reportTrailingBytes(left - packed, cloud);
  return columns;
}

void readCompressed(const LineReader& lines, const PcdHeader& header, CloudFile& cloud) {
  // Old writers leave the two sizes out when there is no point.
  if (cloud.size() == 0 && lines.bytesLeft() == 0) return;
  const std::vector<unsigned char> columns = unpackedBody(lines, header, cloud);
  const std::size_t step = cloud.pointStep();
  cloud.data.resize(cloud.size() * step);
  const unsigned char* from = columns.data();
  auto field = cloud.fields.begin();
  for (const CloudField& column : header.columns) {
    const std::size_t bytes = sizeOf(column.type) * column.count;
    if (column.name != "_" && cloud.size() > 0) {
      RowMap map;
      map.add(0, field->offset, bytes);
      map.apply(from, bytes, cloud.data.data(), step, cloud.size());
      ++field;
    }
    from += bytes * cloud.size();
  }
  fromLittleEndian(cloud);
}

} // namespace

CloudFile readPcd(const Source& source) {
  std::vector<std::string> warnings;
  LineReader lines(source, byteOrderMark(source, &warnings));
  PcdHeader header = readPcdHeader(lines);
  CloudFile cloud = std::move(header.cloud);
  cloud.warnings.insert(cloud.warnings.begin(), warnings.begin(), warnings.end());
  const RowMap map = dropPadding(header, cloud);
  requireCoordinates(source, cloud);
  if (cloud.format == CloudFormat::PcdAscii)
    readAscii(lines, header, cloud);
  else if (cloud.format == CloudFormat::PcdBinary)
    readBinary(lines, header, map, cloud);
  else
    readCompressed(lines, header, cloud);
  lines.reportLineEnds(cloud.warnings);
  return cloud;
}

} // namespace pcl_gpf
