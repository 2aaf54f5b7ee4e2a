// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pcl_gpf/common/export.h"
#include "pcl_gpf/io/mesh_file.h"

namespace pcl_gpf {

/** \brief A mesh to be written: triangles, and what its vertices carry. */
struct MeshFile {
  TriangleMesh mesh;
  std::vector<float> normals;        ///< x y z per vertex, or empty
  std::vector<std::uint8_t> colors;  ///< red green blue per vertex, or empty
  std::vector<std::string> comments; ///< of the header, one line each
};

struct MeshWriteOptions {
  /** \brief Replace an existing file. */
  bool overwrite = false;
  /** \brief Coordinates as double, for places far from the origin; else float, unless one is beyond it. */
  bool double_coordinates = false;
};

/** \brief Writes a binary little-endian PLY file, atomically (see AtomicFile).
 *
 * \param path ends in .ply (any case), or "-" for standard output
 * \throws IoError (kind Unwritable); std::invalid_argument when arrays do not fit together, a vertex number is beyond the
 * vertices, or a coordinate is not finite
 */
PCL_GPF_EXPORT void writeMesh(const MeshFile& mesh, const std::string& path, const MeshWriteOptions& options = {});

/** \brief Fails when a path does not name a PLY file or cannot be written; to be asked before the work.
 * \throws IoError (kind Unwritable)
 */
PCL_GPF_EXPORT void checkMeshWritable(const std::string& path, bool overwrite);

} // namespace pcl_gpf
