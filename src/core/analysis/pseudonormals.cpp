// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/pseudonormals.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl_gpf {
namespace {

/** \brief Numbers equal keys alike, 0 .. different - 1. \return the number of different keys */
template <class Key>
std::uint32_t
numberEqualKeys(const std::vector<Key>& keys, std::vector<std::array<std::uint32_t, 3>>& numbers)
{
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  numbers.resize(keys.size() / 3);
  std::uint32_t number = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    if (rank > 0 && keys[order[rank - 1]] < keys[order[rank]])
      ++number;
    numbers[order[rank] / 3][order[rank] % 3] = number;
  }
  return keys.empty() ? 0 : number + 1;
}

} // namespace

Pseudonormals::Pseudonormals(const std::vector<TriangleCorners>& corners) : faces_(corners.size())
{
  std::vector<Position> positions;
  positions.reserve(3 * corners.size());
  for (const TriangleCorners& triangle : corners)
    positions.insert(positions.end(), triangle.begin(), triangle.end());
  vertices_.assign(numberEqualKeys(positions, vertex_of_), {0, 0, 0});
  for (std::size_t triangle = 0; triangle < corners.size(); ++triangle)
    addFace(triangle, corners[triangle]);
  sumEdges();
}

void
Pseudonormals::addFace(std::size_t triangle, const TriangleCorners& corners)
{
  const Position normal = cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0]));
  faces_[triangle] = normalized(normal);
  for (std::size_t k = 0; k < 3; ++k) {
    const Position to_next = subtract(corners[(k + 1) % 3], corners[k]);
    const Position to_previous = subtract(corners[(k + 2) % 3], corners[k]);
    const double angle = std::atan2(length(normal), dot(to_next, to_previous));
    Position& vertex = vertices_[vertex_of_[triangle][k]];
    vertex = addScaled(vertex, angle, faces_[triangle]);
  }
}

void
Pseudonormals::sumEdges()
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  ends.reserve(3 * faces_.size());
  for (const auto& vertex : vertex_of_)
    for (std::size_t k = 0; k < 3; ++k)
      ends.emplace_back(std::min(vertex[k], vertex[(k + 1) % 3]), std::max(vertex[k], vertex[(k + 1) % 3]));
  edges_.assign(numberEqualKeys(ends, edge_of_), {0, 0, 0});
  for (std::size_t triangle = 0; triangle < faces_.size(); ++triangle)
    for (const std::uint32_t edge : edge_of_[triangle])
      edges_[edge] = addScaled(edges_[edge], 1.0, faces_[triangle]);
}

const Position&
Pseudonormals::at(std::size_t triangle, TriangleFeature feature) const
{
  switch (feature) {
  case TriangleFeature::Edge0:
  case TriangleFeature::Edge1:
  case TriangleFeature::Edge2:
    return edges_[edge_of_[triangle][static_cast<std::size_t>(feature) - static_cast<std::size_t>(TriangleFeature::Edge0)]];
  case TriangleFeature::Corner0:
  case TriangleFeature::Corner1:
  case TriangleFeature::Corner2:
    return vertices_[vertex_of_[triangle]
                               [static_cast<std::size_t>(feature) - static_cast<std::size_t>(TriangleFeature::Corner0)]];
  case TriangleFeature::Face:
    break;
  }
  return faces_[triangle];
}

} // namespace pcl_gpf
