// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "methods.h"

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Variants of another filter: "mls", "jet", "bilateral", "wlop" with what a user has who sets nothing, and the
 * same with "-best" behind for a grid of settings; "wlop-half" keeps half of the points, as the papers do. No variants for
 * other names, and for all when the program was built without the peers. */
std::vector<Variant>
peerVariants(const std::string& name);

} // namespace pcl_gpf::quality
