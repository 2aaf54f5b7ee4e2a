// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/analysis/triangle.h"

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Normals of the faces, edges and vertices of a mesh, of any length: what tells inside from outside.
 *
 * Edge: sum of the unit normals of its faces. Vertex: the same, weighted by the angles there (Baerentzen and Aanaes 2005).
 */
class Pseudonormals {
public:
  /** \param[in] corners of the triangles; corners at the same position are one vertex */
  explicit Pseudonormals(const std::vector<TriangleCorners>& corners);

  const Position&
  at(std::size_t triangle, TriangleFeature feature) const;

private:
  void
  addFace(std::size_t triangle, const TriangleCorners& corners);
  void
  sumEdges();

  std::vector<Position> faces_;
  std::vector<Position> vertices_;
  std::vector<Position> edges_;                       ///< one per pair of vertices
  std::vector<std::array<std::uint32_t, 3>> vertex_of_; ///< per triangle and corner
  std::vector<std::array<std::uint32_t, 3>> edge_of_;   ///< per triangle and edge
};

} // namespace pcl_gpf
