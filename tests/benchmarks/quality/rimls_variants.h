// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "methods.h"

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Projection onto the RIMLS surface of the noisy points (pcl_gpf/core/operators/rimls.h): "rimls" with its own
 * defaults, "rimls-best" with a grid of radii and widths; no variants for other names. Normals: plane fits and bilateral
 * filter with estimated lengths, oriented by orientNormals() for "rimls" and by the truth for "rimls-best". */
std::vector<Variant>
rimlsVariants(const std::string& name);

} // namespace pcl_gpf::quality
