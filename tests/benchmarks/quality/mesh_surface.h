// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <pcl_gpf/io/mesh_file.h>

#include <memory>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief A triangle mesh as truth; sharp edges are those with more than 30 degrees between their faces. Vertices at
 * the same position count as one. */
std::shared_ptr<const Surface>
meshSurface(const TriangleMesh& mesh);

/** \brief A mesh of the shared data (PCL_GPF_SHARED_DIR), by its file name without extension.
 * \throws std::runtime_error when it is not there */
std::shared_ptr<const Surface>
sharedMeshSurface(const std::string& name);

/** \brief Names of all shared meshes, ascending; empty when there is no shared data. */
std::vector<std::string>
sharedMeshNames();

} // namespace pcl_gpf::quality
