// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_gpf {

/** \brief Polygons of a surface in one cell of a lattice.
 *
 * Corner c of a cell lies at x = c & 1, y = c >> 1 & 1, z = c >> 2 & 1. Edge 4 a + k runs along axis a from the k-th of
 * the corners that have 0 on that axis.
 */
struct CellPolygons {
  static constexpr std::size_t kEdges = 12;

  /** Vertices of all polygons one after another, as edges, counterclockwise seen from the positive side. */
  std::array<std::uint8_t, kEdges> edges{};
  /** Number of vertices of each polygon, 3 .. 12. */
  std::array<std::uint8_t, 4> sizes{};
  std::size_t count = 0;
};

/** \brief Corner at which an edge begins. */
constexpr unsigned
edgeCorner(unsigned edge)
{
  const unsigned axis = edge / 4, k = edge % 4, low = k & ((1u << axis) - 1u);
  return low | (k >> axis) << (axis + 1);
}

/** \brief Axis along which an edge runs. */
constexpr unsigned
edgeAxis(unsigned edge)
{
  return edge / 4;
}

/** \brief Bit c is set when values[c] > 0. */
unsigned
signMask(const float* values);

/** \brief Polygons of the surface between corners with values > 0 and the others. \param[in] values of the 8 corners,
 * finite */
CellPolygons
traceCell(const float* values);

/** \brief Vertex of a polygon from which all diagonals stay inside the cell; `size` when there is none. A diagonal in a
 * face of the cell might be an edge of the neighbour, too.
 * \param[in] edges of the polygon's vertices */
std::size_t
fanApex(const std::uint8_t* edges, std::size_t size);

} // namespace pcl_gpf
