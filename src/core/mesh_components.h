// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/surface_mesh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Root of the set of vertices that triangles connect, for every vertex; the root is the least vertex. */
std::vector<std::uint32_t>
componentRoots(const SurfaceMesh& mesh);

/** \brief Triangles of the component of each root. */
std::vector<std::size_t>
componentSizes(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& roots);

} // namespace pcl_gpf
