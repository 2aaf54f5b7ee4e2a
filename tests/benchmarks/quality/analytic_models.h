// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <memory>
#include <string>

namespace pcl_gpf::quality {

/** \brief cube, block, sphere, relief, cylinder, torus, plane or cap; null for other names. */
std::shared_ptr<const Surface>
analyticSurface(const std::string& name);

/** \brief Two parallel unit squares `gap` apart, normals outwards. */
std::shared_ptr<const Surface>
sheetsSurface(double gap);

} // namespace pcl_gpf::quality
