// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/text_lines.h"

namespace pcl_gpf {

enum class Content { Pcd, Ply, Other };

/** \brief What the first bytes say; the name is not looked at. */
Content detectContent(const Source& source);

} // namespace pcl_gpf
