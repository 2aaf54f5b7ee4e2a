// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief `count` points spread over a mesh with equal density per area, repeatable by `seed`.
 *
 * \param[in] vertices x y z per vertex
 * \param[in] triangles three vertex numbers per triangle, all below the number of vertices
 * \throws UnsuitableData if the mesh has no area or is not finite
 * Cost: O(T + count log T).
 */
PCL_GPF_CORE_EXPORT std::vector<Position>
sampleSurface(const std::vector<double>& vertices,
              const std::vector<std::uint32_t>& triangles,
              std::size_t count,
              std::uint64_t seed);

} // namespace pcl_gpf
