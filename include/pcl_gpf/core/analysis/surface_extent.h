// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Whether points span an area: at least 3, and neither all at one place nor all on one line (to a millionth of their
 * extent, which is the rounding of float). Where a few points lie far away the others alone are asked, too (denseBox()).
 * \param[in] points in any one unit, finite. Cost: two passes; some more where the answer is no or a point lies far away. */
PCL_GPF_CORE_EXPORT bool
spansSurface(PointsView points);

} // namespace pcl_gpf
