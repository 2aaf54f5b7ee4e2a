// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/read_cloud.h"

#include <algorithm>

#include "io/content.h"
#include "io/format_limits.h"
#include "io/format_readers.h"
#include "io/input_bytes.h"
#include "io/pcd_header.h"

namespace pcl_gpf {

namespace {

bool nameAllowsXyz(const std::string& name) {
  const std::string extension = extensionOf(name);
  for (const char* allowed : {".xyz", ".txt", ".asc", ".pts", ".csv"})
    if (extension == allowed) return true;
  return false;
}

/** A PCD file starts with comments and then a keyword. */
bool looksLikePcd(const Source& source) {
  const Source start{source.data, std::min(source.size, kMaxHeaderBytes), source.name};
  LineReader lines(start, byteOrderMark(source, nullptr));
  std::string_view line;
  std::string_view token;
  while (lines.nextFilled(line)) {
    takeToken(line, token);
    if (token[0] != '#') return isPcdKeyword(token);
  }
  return false;
}

} // namespace

Content detectContent(const Source& source) {
  const std::size_t begin = byteOrderMark(source, nullptr);
  const std::string_view start(reinterpret_cast<const char*>(source.data) + begin,
                               std::min<std::size_t>(source.size - begin, 4));
  const bool ends_after_mark =
      start.size() == 3 ||
      (start.size() == 4 && (start[3] == '\n' || start[3] == '\r' || start[3] == ' ' || start[3] == '\t'));
  if (start.substr(0, 3) == "ply" && ends_after_mark) return Content::Ply;
  return looksLikePcd(source) ? Content::Pcd : Content::Other;
}

namespace {

[[noreturn]] void refuseContent(const Source& source) {
  const std::string_view start(reinterpret_cast<const char*>(source.data), std::min<std::size_t>(source.size, 16));
  source.fail("a PCD or PLY header (or XYZ text under the extension .xyz, .txt, .asc, .pts or .csv)",
              "the bytes " + quoted(start));
}

CloudFile readSource(const Source& source, bool xyz_allowed) {
  if (source.size == 0) source.fail("a PCD, PLY or XYZ point cloud", "an empty file");
  const Content content = detectContent(source);
  if (content == Content::Ply) return readPly(source);
  if (content == Content::Pcd) return readPcd(source);
  if (!xyz_allowed) refuseContent(source);
  return readXyz(source);
}

} // namespace

CloudFile readCloud(const std::string& path) {
  const bool is_standard_input = path == "-";
  const bool xyz_allowed = is_standard_input || nameAllowsXyz(path);
  const std::string name = is_standard_input ? "standard input" : path;
  const InputBytes bytes = readInput(path, [&](const unsigned char* data, std::size_t size) {
    const Source start{data, size, name};
    if (!xyz_allowed && detectContent(start) == Content::Other) refuseContent(start);
  });
  return readSource({bytes.data.get(), bytes.size, name}, xyz_allowed);
}

CloudFile readCloudBuffer(const unsigned char* data, std::size_t size, const std::string& name) {
  return readSource({data, size, name}, nameAllowsXyz(name));
}

void requireCoordinates(const Source& source, const CloudFile& cloud) {
  for (const char* name : {"x", "y", "z"}) {
    const int field = cloud.findField(name);
    if (field < 0) source.fail(std::string("a field ") + name, "none of that name (names are case-sensitive)");
    if (cloud.fields[static_cast<std::size_t>(field)].count != 1)
      source.fail(std::string("one element in field ") + name,
                  std::to_string(cloud.fields[static_cast<std::size_t>(field)].count));
  }
}

void reportTrailingLines(LineReader& lines, CloudFile& cloud) {
  const std::size_t end = lines.position();
  std::string_view line;
  if (lines.nextFilled(line))
    cloud.warnings.push_back("text after the last promised row, from byte " + std::to_string(end) + ", is ignored");
}

void reportTrailingBytes(std::size_t bytes, CloudFile& cloud) {
  if (bytes > 0) cloud.warnings.push_back(std::to_string(bytes) + " bytes after the last promised one are ignored");
}

void requireBytes(const Source& source, std::size_t body, std::uint64_t rows, std::uint64_t row_bytes,
                  std::size_t left) {
  std::uint64_t promised = 0;
  const bool overflow = __builtin_mul_overflow(rows, row_bytes, &promised);
  if (overflow || promised > left)
    source.failAtByte(body,
                      "at least " + std::to_string(row_bytes) + " bytes for each of " + std::to_string(rows) + " rows",
                      std::to_string(left) + " bytes in all");
}

} // namespace pcl_gpf
