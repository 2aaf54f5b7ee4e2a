// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "io/element_bytes.h"
#include "io/format_writers.h"
#include "io/lzf.h"
#include "io/viewpoint_text.h"
#include "io/write_blocks.h"

namespace pcl_gpf {

namespace {

char typeLetter(FieldType type) {
  switch (type) {
  case FieldType::Float32:
  case FieldType::Float64:
    return 'F';
  case FieldType::UInt8:
  case FieldType::UInt16:
  case FieldType::UInt32:
  case FieldType::UInt64:
    return 'U';
  default:
    return 'I';
  }
}

/** One header line: \a keyword and a value for every field. */
template <typename Value>
std::string fieldLine(const char* keyword, const OutputLayout& layout, Value value) {
  std::string line = keyword;
  for (const CloudField& field : layout.fields) {
    line += ' ';
    line += value(field);
  }
  return line + '\n';
}

std::string header(const CloudFile& cloud, const OutputLayout& layout, const char* kind) {
  std::string text = "# .PCD v0.7 - Point Cloud Data file format\n";
  for (const std::string& comment : commentLines(cloud))
    text += "# " + comment + '\n';
  text += "VERSION 0.7\n";
  text += fieldLine("FIELDS", layout, [](const CloudField& field) { return field.name; });
  text += fieldLine("SIZE", layout, [](const CloudField& field) { return std::to_string(sizeOf(field.type)); });
  text += fieldLine("TYPE", layout, [](const CloudField& field) { return typeLetter(field.type); });
  text += fieldLine("COUNT", layout, [](const CloudField& field) { return std::to_string(field.count); });
  text += "WIDTH " + std::to_string(cloud.width) + "\nHEIGHT " + std::to_string(cloud.height) + '\n';
  text += "VIEWPOINT " + viewpointText(cloud.viewpoint) + '\n';
  text += "POINTS " + std::to_string(cloud.size()) + "\nDATA " + kind + '\n';
  return text;
}

/** A packed colour of type float may have the bits of a NaN, which text does not keep. It is then written as the
 * integer that it is, which PCL reads as a colour, too. */
void keepColourBits(const CloudFile& cloud, OutputLayout& layout) {
  for (std::size_t f = 0; f < layout.fields.size(); ++f) {
    CloudField& field = layout.fields[f];
    const int source = cloud.findField(field.name);
    if (!isPackedColour(field) || field.type != FieldType::Float32 || source < 0) continue;
    for (const double value : cloud.column(source)) {
      if (!std::isnan(value)) continue;
      field.type = FieldType::UInt32;
      break;
    }
  }
}

void appendLittleEndian32(std::size_t value, std::string& text) {
  for (unsigned shift = 0; shift < 32; shift += 8)
    text += static_cast<char>(value >> shift & 0xff);
}

void writeCompressedBody(const CloudFile& cloud, const OutputLayout& layout, const ByteSink& sink) {
  std::vector<unsigned char> columns(cloud.size() * layout.step);
  std::size_t field_begin = 0;
  std::size_t row = 0;
  writeBinaryRows(cloud, layout, ListLengths::None, !kHostIsLittleEndian, [&](const void* bytes, std::size_t size) {
    const std::size_t rows = size / layout.step;
    field_begin = 0;
    for (const CloudField& field : layout.fields) {
      const std::size_t field_bytes = sizeOf(field.type) * field.count;
      RowMap map;
      map.add(field.offset, 0, field_bytes);
      map.apply(static_cast<const unsigned char*>(bytes), layout.step, columns.data() + field_begin + row * field_bytes,
                field_bytes, rows);
      field_begin += field_bytes * cloud.size();
    }
    row += rows;
  });
  const std::vector<unsigned char> packed = lzfCompress(columns.data(), columns.size());
  std::string sizes;
  appendLittleEndian32(packed.size(), sizes);
  appendLittleEndian32(columns.size(), sizes);
  sink(sizes.data(), sizes.size());
  sink(packed.data(), packed.size());
}

} // namespace

void writePcd(const CloudFile& cloud, CloudFormat format, const ByteSink& sink) {
  OutputLayout layout = pcdLayout(cloud);
  const bool is_text = format == CloudFormat::PcdAscii;
  if (is_text) keepColourBits(cloud, layout);
  const char* kind = is_text ? "ascii" : format == CloudFormat::PcdBinary ? "binary" : "binary_compressed";
  const std::string text = header(cloud, layout, kind);
  sink(text.data(), text.size());
  if (is_text)
    writeTextRows(cloud, layout, ListLengths::None, sink);
  else if (format == CloudFormat::PcdBinary)
    writeBinaryRows(cloud, layout, ListLengths::None, !kHostIsLittleEndian, sink);
  else
    writeCompressedBody(cloud, layout, sink);
}

} // namespace pcl_gpf
