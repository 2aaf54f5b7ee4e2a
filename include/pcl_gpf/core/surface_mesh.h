// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Triangles over shared vertices with normals. */
struct SurfaceMesh {
  SoaBuffer vertices;
  SoaBuffer normals;                    ///< unit vectors, one a vertex
  std::vector<std::uint32_t> triangles; ///< 3 vertices each, counterclockwise seen from outside

  std::size_t vertexCount() const { return vertices.size(); }
  std::size_t triangleCount() const { return triangles.size() / 3; }
};

/** \brief How the triangles of a mesh hang together. */
struct MeshTopology {
  std::size_t edges = 0;
  std::size_t open_edges = 0;         ///< with one triangle: the border of the surface
  std::size_t inconsistent_edges = 0; ///< with more than two triangles, or two that run along them in the same direction
  std::size_t components = 0;         ///< sets of triangles connected by vertices
  std::int64_t euler_characteristic = 0; ///< used vertices - edges + triangles; 2 - 2 genus for each closed component
};

/** \brief Counts edges and components. Cost: one sort of 3 values a triangle. */
PCL_GPF_CORE_EXPORT MeshTopology
meshTopology(const SurfaceMesh& mesh);

/** \brief Removes the connected components with fewer triangles than `share` of the largest one's, and the vertices that only they use.
 *
 * \param[in] share 0 .. 1; 0 removes nothing. Order is kept. \return number of components removed \throws InvalidParameter */
PCL_GPF_CORE_EXPORT std::size_t
removeSmallComponents(SurfaceMesh& mesh, double share);

/** \brief Removes triangles with a vertex that is not finite or farther than `distance` from every point, those with a vertex twice, and
 * then the vertices without triangles.
 *
 * \param[in] distance in the unit of the points, >= 0; infinity: only what is not finite goes */
PCL_GPF_CORE_EXPORT void
trimMesh(SurfaceMesh& mesh, const PointIndex& points, double distance, unsigned number_of_threads = 0);

/** \brief Closes holes of at most so many edges by fans about their middle; the rim of a small patch is none. Places where holes touch
 * are left open.
 *
 * \param[in] most_edges below 3 fills nothing \return number of holes closed */
PCL_GPF_CORE_EXPORT std::size_t
fillSmallHoles(SurfaceMesh& mesh, std::size_t most_edges);

/** \brief Makes vertex normals unit vectors; those without a direction become the mean normal of their faces. */
PCL_GPF_CORE_EXPORT void
completeNormals(SurfaceMesh& mesh);

} // namespace pcl_gpf
