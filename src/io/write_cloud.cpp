// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/write_cloud.h"

#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include "io/format_limits.h"
#include "io/format_writers.h"
#include "io/input_bytes.h"
#include "io/output_bytes.h"
#include "io/ply_header.h"
#include "io/text_lines.h"
#include "pcl_gpf/io/errors.h"

namespace pcl_gpf {

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& promised, const std::string& found) {
  throw IoError(IoErrorKind::Unwritable, path, "", promised, found);
}

bool isText(CloudFormat format) {
  return format == CloudFormat::PcdAscii || format == CloudFormat::PlyAscii || format == CloudFormat::Xyz;
}

bool isPcd(CloudFormat format) {
  return format == CloudFormat::PcdAscii || format == CloudFormat::PcdBinary || format == CloudFormat::PcdCompressed;
}

bool isPly(CloudFormat format) {
  return !isPcd(format) && format != CloudFormat::Xyz;
}

void validate(const CloudFile& cloud) {
  std::size_t offset = 0;
  std::set<std::string> names;
  for (const CloudField& field : cloud.fields) {
    const bool is_token = splitTokens(field.name).size() == 1 && trimmed(field.name) == field.name;
    if (!is_token || !names.insert(field.name).second)
      throw std::invalid_argument("a field name is used twice, is empty or holds blanks: '" + field.name + "'");
    if (field.offset != offset || field.count == 0) throw std::invalid_argument("the rows of the cloud are not packed");
    offset += sizeOf(field.type) * field.count;
  }
  if (cloud.data.size() != cloud.size() * offset)
    throw std::invalid_argument("the cloud's data do not hold width x height rows");
  for (const char* name : {"x", "y", "z"}) {
    const int field = cloud.findField(name);
    if (field < 0 || cloud.fields[static_cast<std::size_t>(field)].count != 1)
      throw std::invalid_argument(std::string("the cloud needs a field ") + name + " with one element");
  }
}

/** The integer limits within which every value is exact as a double. */
bool isExactAsDouble(const CloudField& field, const unsigned char* element) {
  constexpr std::uint64_t kLimit = std::uint64_t{1} << std::numeric_limits<double>::digits;
  std::uint64_t bits = 0;
  std::memcpy(&bits, element, sizeof bits);
  const bool is_negative = field.type == FieldType::Int64 && (bits >> 63) != 0;
  return (is_negative ? 0 - bits : bits) <= kLimit;
}

void checkWideIntegers(const CloudFile& cloud, const std::string& path) {
  const std::size_t step = cloud.pointStep();
  for (const CloudField& field : cloud.fields) {
    if (plyTypeName(field.type)) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      for (std::uint32_t k = 0; k < field.count; ++k)
        if (!isExactAsDouble(field, cloud.data.data() + i * step + field.offset + k * sizeof(double)))
          refuse(path, "integers up to 2^53, for PLY has none of 64 bits (PCD has)",
                 "a larger one in field '" + field.name + "' of point " + std::to_string(i));
  }
}

void writeAs(const CloudFile& cloud, CloudFormat format, const ByteSink& sink) {
  if (isPcd(format))
    writePcd(cloud, format, sink);
  else if (isPly(format))
    writePly(cloud, format, sink);
  else
    writeXyz(cloud, sink);
}

} // namespace

CloudFormat formatForPath(const std::string& path, const CloudFile& cloud) {
  if (path == "-") return cloud.format;
  const std::string extension = extensionOf(path);
  const bool as_text = isText(cloud.format);
  if (extension == ".pcd") {
    if (isPcd(cloud.format)) return cloud.format;
    return as_text ? CloudFormat::PcdAscii : CloudFormat::PcdBinary;
  }
  if (extension == ".ply") {
    if (isPly(cloud.format)) return cloud.format;
    return as_text ? CloudFormat::PlyAscii : CloudFormat::PlyLittleEndian;
  }
  for (const char* xyz : {".xyz", ".txt", ".asc", ".pts"})
    if (extension == xyz) return CloudFormat::Xyz;
  refuse(path, "the extension .pcd, .ply, .xyz, .txt, .asc or .pts",
         extension.empty() ? "none" : "'" + extension + "'");
}

void checkFits(const CloudFile& cloud, CloudFormat format, const std::string& path) {
  std::uint64_t columns = 0;
  for (const CloudField& field : cloud.fields)
    columns += format == CloudFormat::Xyz ? field.count : 1;
  // Packed colours become up to four columns.
  if (columns + 3 > kMaxFields) refuse(path, "fewer than 997 columns", std::to_string(columns));
  if (cloud.size() > kMaxCount) refuse(path, "at most 2^31 - 1 points", std::to_string(cloud.size()));
  const std::size_t bytes = cloud.size() * cloud.pointStep();
  // The packed size, at most 1/32 more, has 32 bits, too.
  constexpr std::size_t kMaxCompressible = std::numeric_limits<std::uint32_t>::max() / 33 * 32;
  if (format == CloudFormat::PcdCompressed && bytes > kMaxCompressible)
    refuse(path, "less than 4 GiB for PCD binary_compressed (binary has no limit)", std::to_string(bytes) + " bytes");
  if (isPly(format)) checkWideIntegers(cloud, path);
}

void writeCloud(const CloudFile& cloud, const std::string& path, const WriteOptions& options) {
  validate(cloud);
  const CloudFormat format = options.format ? *options.format : formatForPath(path, cloud);
  checkFits(cloud, format, path);
  if (path == "-") {
    writeAs(cloud, format, standardOutputSink());
    return;
  }
  checkWritable(path, options.overwrite);
  AtomicFile file(path, options.overwrite);
  writeAs(cloud, format, [&file](const void* bytes, std::size_t size) { file.write(bytes, size); });
  file.commit();
}

} // namespace pcl_gpf
