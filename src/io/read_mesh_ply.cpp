// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "io/element_bytes.h"
#include "io/mesh_readers.h"
#include "io/ply_cursor.h"

namespace pcl_gpf {

namespace {

void readVertices(PlyCursor& cursor, const PlyElement& element, TriangleMesh& mesh) {
  for (const char* axis : {"x", "y", "z"}) {
    const PlyProperty* property = element.find(axis);
    if (!property || property->is_list) cursor.fail(std::string("a vertex property ") + axis, "none");
  }
  mesh.vertices.resize(3 * static_cast<std::size_t>(element.count));
  double* vertex = mesh.vertices.data();
  for (std::uint64_t i = 0; i < element.count; ++i, vertex += 3) {
    cursor.beginRow();
    for (const PlyProperty& property : element.properties) {
      const bool is_axis = property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
      if (!is_axis) {
        cursor.skip(property);
        continue;
      }
      unsigned char bytes[8];
      cursor.readValue(property, bytes);
      const double value = loadElement(property.type, bytes);
      if (!std::isfinite(value)) cursor.fail("a finite vertex", "nan or inf");
      vertex[property.name[0] - 'x'] = value;
    }
    cursor.endRow();
  }
}

void readPolygon(PlyCursor& cursor, const PlyProperty& property, std::uint64_t vertices,
                 std::vector<std::uint32_t>& polygon) {
  const std::uint64_t corners = cursor.readLength(property);
  if (corners < 3) cursor.fail("a face of at least three corners", std::to_string(corners));
  polygon.clear();
  for (std::uint64_t k = 0; k < corners; ++k) {
    unsigned char bytes[8];
    cursor.readValue(property, bytes);
    const double index = loadElement(property.type, bytes);
    const bool is_vertex = index >= 0 && index < static_cast<double>(vertices) && index == std::floor(index);
    if (!is_vertex) cursor.fail("a vertex number below " + std::to_string(vertices), std::to_string(index));
    polygon.push_back(static_cast<std::uint32_t>(index));
  }
}

void readFaces(PlyCursor& cursor, const PlyElement& element, std::uint64_t vertices, TriangleMesh& mesh) {
  const PlyProperty* corners = element.find("vertex_indices");
  if (!corners) corners = element.find("vertex_index");
  if (!corners || !corners->is_list) cursor.fail("a list vertex_indices in element face", "none");
  std::vector<std::uint32_t> polygon;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    cursor.beginRow();
    for (const PlyProperty& property : element.properties) {
      if (&property == corners)
        readPolygon(cursor, property, vertices, polygon);
      else
        cursor.skip(property);
    }
    cursor.endRow();
    appendFan(polygon, mesh);
  }
}

} // namespace

TriangleMesh readMeshPly(const Source& source) {
  LineReader lines(source, byteOrderMark(source, nullptr));
  const PlyHeader header = readPlyHeader(lines);
  std::uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices = element.count;
  TriangleMesh mesh;
  PlyCursor cursor(lines, header.format);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      readVertices(cursor, element, mesh);
    else if (element.name == "face")
      readFaces(cursor, element, vertices, mesh);
    else
      cursor.skip(element);
  }
  if (mesh.triangles.empty()) source.fail("at least one face", "none");
  return mesh;
}

} // namespace pcl_gpf
