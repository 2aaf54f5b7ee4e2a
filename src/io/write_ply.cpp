// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include "io/element_bytes.h"
#include "io/format_writers.h"
#include "io/ply_header.h"
#include "io/viewpoint_text.h"
#include "io/write_blocks.h"

namespace pcl_gpf {

namespace {

const char* formatName(CloudFormat format) {
  if (format == CloudFormat::PlyAscii) return "ascii";
  return format == CloudFormat::PlyBigEndian ? "binary_big_endian" : "binary_little_endian";
}

std::string header(const CloudFile& cloud, const OutputLayout& layout, CloudFormat format) {
  std::string text = std::string("ply\nformat ") + formatName(format) + " 1.0\n";
  for (const std::string& comment : commentLines(cloud))
    text += "comment " + comment + '\n';
  if (cloud.viewpoint != kIdentityViewpoint) text += "comment viewpoint " + viewpointText(cloud.viewpoint) + '\n';
  if (cloud.isOrganized())
    text += "obj_info num_cols " + std::to_string(cloud.width) + "\nobj_info num_rows " + std::to_string(cloud.height) +
            '\n';
  text += "element vertex " + std::to_string(cloud.size()) + '\n';
  for (const CloudField& field : layout.fields) {
    text += "property ";
    if (field.count > 1) text += std::string("list ") + plyTypeName(listLengthType(field.count)) + ' ';
    text += std::string(plyTypeName(field.type)) + ' ' + field.name + '\n';
  }
  return text + "end_header\n";
}

/** PLY has no 64-bit integers: they become doubles, of the same size and (checkFits) the same value. */
bool hasWideIntegers(const CloudFile& cloud) {
  for (const CloudField& field : cloud.fields)
    if (!plyTypeName(field.type)) return true;
  return false;
}

CloudFile withoutWideIntegers(CloudFile cloud) {
  const std::size_t step = cloud.pointStep();
  for (CloudField& field : cloud.fields) {
    if (plyTypeName(field.type)) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      unsigned char* element = cloud.data.data() + i * step + field.offset;
      for (std::uint32_t k = 0; k < field.count; ++k, element += sizeof(double))
        storeElement(FieldType::Float64, loadElement(field.type, element), element);
    }
    field.type = FieldType::Float64;
  }
  return cloud;
}

} // namespace

void writePly(const CloudFile& cloud, CloudFormat format, const ByteSink& sink) {
  if (hasWideIntegers(cloud)) {
    writePly(withoutWideIntegers(cloud), format, sink);
    return;
  }
  const OutputLayout layout = plyLayout(cloud);
  const std::string text = header(cloud, layout, format);
  sink(text.data(), text.size());
  if (format == CloudFormat::PlyAscii) {
    writeTextRows(cloud, layout, ListLengths::Written, sink);
    return;
  }
  const bool is_host_order = (format == CloudFormat::PlyLittleEndian) == kHostIsLittleEndian;
  writeBinaryRows(cloud, layout, ListLengths::Written, !is_host_order, sink);
}

} // namespace pcl_gpf
