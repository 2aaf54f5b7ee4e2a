// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface.h"

#include <memory>

namespace pcl_gpf::quality {

/** \brief A closed five-pointed star: ten slanted faces above and ten below a narrow upright wall; ridges and valleys
 * of several angles. */
std::shared_ptr<const Surface>
starSurface();

} // namespace pcl_gpf::quality
