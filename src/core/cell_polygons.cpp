// SPDX-License-Identifier: BSD-3-Clause
#include "cell_polygons.h"

namespace pcl_gpf {

namespace {

constexpr std::uint8_t kNone = 255;

struct Face {
  std::array<std::uint8_t, 4> corners; ///< counterclockwise seen from outside the cell
  std::array<std::uint8_t, 4> edges;   ///< edge k joins corners k and k + 1
};

unsigned
edgeBetween(unsigned a, unsigned b)
{
  const unsigned axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  const unsigned corner = a & b; // has 0 on the axis
  const unsigned low = corner & ((1u << axis) - 1u);
  return 4 * axis + (low | (corner >> (axis + 1)) << axis);
}

std::array<Face, 6>
makeFaces()
{
  std::array<Face, 6> faces{};
  for (unsigned axis = 0; axis < 3; ++axis)
    for (unsigned side = 0; side < 2; ++side) {
      const unsigned b = 1u << (axis + 1) % 3, c = 1u << (axis + 2) % 3, base = side << axis;
      Face& face = faces[2 * axis + side];
      // counterclockwise seen along -axis
      const std::array<unsigned, 4> around = {base, base | b, base | b | c, base | c};
      for (std::size_t k = 0; k < 4; ++k)
        face.corners[k] = static_cast<std::uint8_t>(around[side == 1 ? k : 3 - k]);
      for (std::size_t k = 0; k < 4; ++k)
        face.edges[k] = static_cast<std::uint8_t>(edgeBetween(face.corners[k], face.corners[(k + 1) % 4]));
    }
  return faces;
}

const std::array<Face, 6>&
faces()
{
  static const std::array<Face, 6> kFaces = makeFaces();
  return kFaces;
}

/** Bit f is set when the edge lies in face f. */
unsigned
facesOfEdge(unsigned edge)
{
  const unsigned axis = edgeAxis(edge), corner = edgeCorner(edge);
  unsigned mask = 0;
  for (unsigned other = 0; other < 3; ++other)
    if (other != axis)
      mask |= 1u << (2 * other + (corner >> other & 1u));
  return mask;
}

/** Adds the face's segments as next[edge] = edge. Round the face, a segment begins where the sign turns negative and
 * ends where it turns positive: the positive side is then on the left of the polygon. */
void
linkFace(const Face& face, const float* values, unsigned signs, std::array<std::uint8_t, CellPolygons::kEdges>& next)
{
  const auto positive = [&](std::size_t k) { return (signs >> face.corners[k % 4] & 1u) != 0; };
  unsigned crossings = 0;
  for (std::size_t k = 0; k < 4; ++k)
    crossings += positive(k) != positive(k + 1);
  if (crossings == 0)
    return;
  bool negatives_joined = false;
  if (crossings == 4) {
    const std::size_t first = positive(0) ? 0 : 1;
    const auto value = [&](std::size_t k) { return values[face.corners[k % 4]]; };
    // At the saddle of the bilinear function; the products are the same from both sides of the face.
    negatives_joined = !(value(first) * value(first + 2) > value(first + 1) * value(first + 3));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (!positive(k) || positive(k + 1))
      continue;
    std::size_t end = k + 1;
    if (negatives_joined)
      end = k + 3; // the crossing before this one: cuts off the positive corner between them
    else
      while (positive(end) == positive(end + 1))
        ++end;
    next[face.edges[k]] = face.edges[end % 4];
  }
}

} // namespace

unsigned
signMask(const float* values)
{
  unsigned signs = 0;
  for (unsigned corner = 0; corner < 8; ++corner)
    signs |= static_cast<unsigned>(values[corner] > 0.0f) << corner;
  return signs;
}

CellPolygons
traceCell(const float* values)
{
  const unsigned signs = signMask(values);
  std::array<std::uint8_t, CellPolygons::kEdges> next;
  next.fill(kNone);
  for (const Face& face : faces())
    linkFace(face, values, signs, next);
  CellPolygons polygons;
  std::size_t filled = 0;
  for (std::size_t start = 0; start < CellPolygons::kEdges; ++start) {
    if (next[start] == kNone)
      continue;
    std::uint8_t size = 0;
    for (std::size_t edge = start; next[edge] != kNone; ++size) {
      polygons.edges[filled++] = static_cast<std::uint8_t>(edge);
      const std::size_t following = next[edge];
      next[edge] = kNone;
      edge = following;
    }
    polygons.sizes[polygons.count++] = size;
  }
  return polygons;
}

std::size_t
fanApex(const std::uint8_t* edges, std::size_t size)
{
  for (std::size_t apex = 0; apex < size; ++apex) {
    bool inside = true;
    for (std::size_t k = 2; k + 1 < size; ++k)
      inside = inside && (facesOfEdge(edges[apex]) & facesOfEdge(edges[(apex + k) % size])) == 0;
    if (inside)
      return apex;
  }
  return size;
}

} // namespace pcl_gpf
