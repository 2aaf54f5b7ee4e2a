// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Standard deviation of the noise along the surface normal, from the residuals of quadric fits to local patches, each the
 * smallest of 48 to 768 neighbours that is clearly a surface; the 35 % quantile over patches, so that edges do not count.
 *
 * Within about 10 % on smooth and on sharp-edged shapes up to noise of the patches' own size; too high where noise rivals the parts.
 *
 * \param[in] points in any one unit; the result is in the same
 * \param[in] spacing of the points (estimateSpacing())
 * \return 0 for fewer than 48 points
 */
PCL_GPF_CORE_EXPORT double
estimateNoise(PointsView points, double spacing, unsigned number_of_threads = 0);

/** \brief The same on points that are sorted already. */
PCL_GPF_CORE_EXPORT double
estimateNoise(const PointIndex& points, double spacing, unsigned number_of_threads = 0);

} // namespace pcl_gpf
