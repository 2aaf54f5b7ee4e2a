// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>

#include "io/element_bytes.h"
#include "io/format_readers.h"
#include "io/ply_cursor.h"
#include "io/row_map.h"
#include "io/viewpoint_text.h"

namespace pcl_gpf {

namespace {

/** Entries of each vertex property in the cloud: 1 for a value, the constant length of a list, or 0 for dropped. */
using EntryCounts = std::vector<std::uint32_t>;

/** Finds the lists that have the same length in every row, by a first walk over all of them. */
EntryCounts countEntries(PlyCursor cursor, const PlyElement& vertex) {
  EntryCounts counts(vertex.properties.size(), 1);
  if (!vertex.hasLists()) return counts;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    cursor.beginRow();
    for (std::size_t p = 0; p < counts.size(); ++p) {
      const PlyProperty& property = vertex.properties[p];
      if (!property.is_list) {
        cursor.skip(property);
        continue;
      }
      PlyCursor ahead = cursor;
      const auto length = static_cast<std::uint32_t>(ahead.readLength(property));
      cursor.skip(property);
      if (i == 0)
        counts[p] = length;
      else if (counts[p] != length)
        counts[p] = 0;
    }
    cursor.endRow();
  }
  return counts;
}

/** The name that every format shares, unless the file uses that one, too. */
std::string commonName(const PlyProperty& property, const PlyElement& vertex) {
  const std::string& name = property.name;
  if (name != "nx" && name != "ny" && name != "nz") return name;
  const std::string common = "normal_" + name.substr(1);
  return vertex.find(common) ? name : common;
}

void addFields(const PlyElement& vertex, const EntryCounts& counts, CloudFile& cloud) {
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const PlyProperty& property = vertex.properties[p];
    if (counts[p] == 0) {
      if (vertex.count > 0)
        cloud.warnings.push_back("the list property " + quoted(property.name) +
                                 " is empty or varies in length, and is dropped");
      continue;
    }
    cloud.fields.push_back({commonName(property, vertex), property.type, counts[p], cloud.pointStep()});
  }
}

/** Binary rows without lists: the file's rows are the cloud's. */
void readFixedRows(PlyCursor& cursor, CloudFile& cloud) {
  const std::size_t bytes = cloud.size() * cloud.pointStep();
  const unsigned char* from = cursor.takeBytes(bytes);
  cloud.data.assign(from, from + bytes);
  if (!cursor.swapsBytes()) return;
  const std::size_t step = cloud.pointStep();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (const CloudField& field : cloud.fields)
      swapElements(cloud.data.data() + i * step + field.offset, sizeOf(field.type), field.count);
}

void readRows(PlyCursor& cursor, const PlyElement& vertex, const EntryCounts& counts, CloudFile& cloud) {
  cloud.data.resize(cloud.size() * cloud.pointStep());
  unsigned char* to = cloud.data.data();
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    cursor.beginRow();
    for (std::size_t p = 0; p < counts.size(); ++p) {
      const PlyProperty& property = vertex.properties[p];
      if (counts[p] == 0) {
        cursor.skip(property);
        continue;
      }
      if (property.is_list) cursor.readLength(property); // the first walk knows it
      for (std::uint32_t k = 0; k < counts[p]; ++k, to += sizeOf(property.type))
        cursor.readValue(property, to);
    }
    cursor.endRow();
  }
}

void readVertices(PlyCursor& cursor, const PlyElement& vertex, CloudFile& cloud) {
  const EntryCounts counts = countEntries(cursor, vertex);
  cloud.width = static_cast<std::uint32_t>(vertex.count);
  addFields(vertex, counts, cloud);
  if (!cursor.isText() && !vertex.hasLists())
    readFixedRows(cursor, cloud);
  else
    readRows(cursor, vertex, counts, cloud);
}

/** Rotation matrix, rows first, to the quaternion w x y z (Shepperd's choice of the largest divisor). */
std::array<double, 4> quaternion(const std::array<double, 9>& m) {
  const double trace = m[0] + m[4] + m[8];
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    return {s / 4, (m[7] - m[5]) / s, (m[2] - m[6]) / s, (m[3] - m[1]) / s};
  }
  const std::size_t i = m[4] > m[0] ? (m[8] > m[4] ? 2 : 1) : (m[8] > m[0] ? 2 : 0);
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const double s = 2 * std::sqrt(1 + m[4 * i] - m[4 * j] - m[4 * k]);
  std::array<double, 4> result{};
  result[0] = (m[3 * k + j] - m[3 * j + k]) / s;
  result[1 + i] = s / 4;
  result[1 + j] = (m[3 * i + j] + m[3 * j + i]) / s;
  result[1 + k] = (m[3 * i + k] + m[3 * k + i]) / s;
  return result;
}

/** The camera that PCL writes: view_px view_py view_pz and nine entries x_axisx ... z_axisz. It sets the viewpoint when
 * they are a rotation, and nothing else: its viewport never changes the number of points. */
void readCamera(PlyCursor& cursor, const PlyElement& camera, CloudFile& cloud) {
  static constexpr const char* kNames[12] = {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz",
                                             "y_axisx", "y_axisy", "y_axisz", "z_axisx", "z_axisy", "z_axisz"};
  std::array<double, 12> values{};
  std::size_t found = 0;
  cursor.beginRow();
  for (const PlyProperty& property : camera.properties) {
    if (property.is_list) {
      cursor.skip(property);
      continue;
    }
    unsigned char bytes[8];
    cursor.readValue(property, bytes);
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (property.name != kNames[n]) continue;
      values[n] = loadElement(property.type, bytes);
      ++found;
    }
  }
  cursor.endRow();
  std::array<double, 9> matrix{};
  for (std::size_t n = 0; n < 9; ++n)
    matrix[n] = values[3 + n];
  const std::array<double, 4> rotation = quaternion(matrix);
  double norm = 0;
  for (const double part : rotation)
    norm += part * part;
  constexpr double kUnitTolerance = 1e-3; // the entries are floats
  if (found < values.size() || !(std::abs(norm - 1) < kUnitTolerance)) return;
  cloud.viewpoint = {values[0], values[1], values[2], rotation[0], rotation[1], rotation[2], rotation[3]};
}

/** obj_info num_cols and num_rows give the organisation when they fit the number of points; else they are comments. */
void takeComments(const PlyHeader& header, std::size_t points, CloudFile& cloud) {
  std::optional<std::uint64_t> columns, rows;
  std::vector<std::string> others;
  for (const std::string& comment : header.comments) {
    const std::vector<std::string_view> tokens = splitTokens(comment);
    unsigned char bytes[8];
    const bool is_size =
        tokens.size() == 3 && tokens[0] == "obj_info" && parseElement(FieldType::UInt32, tokens[2], bytes);
    if (is_size && tokens[1] == "num_cols")
      columns = static_cast<std::uint64_t>(loadElement(FieldType::UInt32, bytes));
    else if (is_size && tokens[1] == "num_rows")
      rows = static_cast<std::uint64_t>(loadElement(FieldType::UInt32, bytes));
    else
      others.push_back(comment);
  }
  const bool is_organisation = columns && rows && *rows > 0 && *columns * *rows == points && points > 0;
  for (const std::string& comment : is_organisation ? others : header.comments)
    takeComment(comment, cloud);
  if (!is_organisation) return;
  cloud.width = static_cast<std::uint32_t>(*columns);
  cloud.height = static_cast<std::uint32_t>(*rows);
}

} // namespace

CloudFile readPly(const Source& source) {
  CloudFile cloud;
  LineReader lines(source, byteOrderMark(source, &cloud.warnings));
  const PlyHeader header = readPlyHeader(lines);
  cloud.format = header.format;
  PlyCursor cursor(lines, header.format);
  bool has_vertex = false;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      has_vertex = true;
      readVertices(cursor, element, cloud);
    } else if (element.name == "camera" && element.count == 1) {
      readCamera(cursor, element, cloud);
    } else {
      cursor.skip(element);
    }
  }
  if (!has_vertex) source.fail("an element vertex", "none");
  requireCoordinates(source, cloud);
  cursor.reportTrailing(cloud);
  cursor.lines().reportLineEnds(cloud.warnings);
  takeComments(header, cloud.size(), cloud);
  return cloud;
}

} // namespace pcl_gpf
