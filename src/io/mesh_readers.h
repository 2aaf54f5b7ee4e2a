// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/text_lines.h"
#include "pcl_gpf/io/mesh_file.h"

namespace pcl_gpf {

// One reader per format. Each takes the whole file and gives the whole mesh or throws IoError.
TriangleMesh readMeshPly(const Source& source);
TriangleMesh readMeshOff(const Source& source);
TriangleMesh readMeshObj(const Source& source);

/** \brief Adds the triangles of a polygon of at least three corners: all share its first corner. */
void appendFan(const std::vector<std::uint32_t>& polygon, TriangleMesh& mesh);

} // namespace pcl_gpf
