// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_gpf/common/export.h"

namespace pcl_gpf {

/** \brief Triangles over shared vertices. */
struct TriangleMesh {
  std::vector<double> vertices;         ///< x y z per vertex, finite
  std::vector<std::uint32_t> triangles; ///< 3 vertex numbers per triangle, each below vertexCount()

  std::size_t vertexCount() const noexcept { return vertices.size() / 3; }
  std::size_t triangleCount() const noexcept { return triangles.size() / 3; }
};

/** \brief Reads the vertices and faces of a PLY (all flavours), OFF or OBJ file; polygons are cut into fans.
 *
 * The content decides between PLY and the others; OFF starts with OFF (or COFF, NOFF, CNOFF), and anything else must be
 * OBJ with the extension .obj. OBJ: v and f count (negative numbers count from the end), the other statements of the
 * format are skipped. As strict as readCloud(); a face needs 3 or more vertices that exist, and at least one face must
 * be there.
 * \throws IoError (kind Unreadable), std::bad_alloc
 */
PCL_GPF_EXPORT TriangleMesh readMesh(const std::string& path);

/** \brief The same from memory. \param name stands for the path in messages, and its extension allows OBJ. */
PCL_GPF_EXPORT TriangleMesh readMeshBuffer(const unsigned char* data, std::size_t size, const std::string& name);

} // namespace pcl_gpf
