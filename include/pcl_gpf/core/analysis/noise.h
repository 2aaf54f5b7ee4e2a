// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Standard deviation of the noise along the surface normal, from the residuals of quadric fits to local patches, each about
 * three times as wide as the noise that it shows; a low quantile over patches, so that edges and outliers do not count.
 *
 * Within a fifth on smooth and on sharp-edged shapes for noise from well below the spacing up to 3 % of the diagonal, normal or even, at
 * any density and with 5 % of outliers. Two sheets whose noise overlaps are told from one by the heights of many patches together. Too high
 * where walls of many thicknesses are thinner than about twice the noise; too low where the noise runs along the normal only and is much
 * higher than the parts. Of noise that varies smoothly over the surface it is the root mean square, else that of the quietest parts.
 *
 * \param[in] points in any one unit; the result is in the same
 * \param[in] spacing of the points (estimateSpacing())
 * \return 0 for fewer than 48 points
 * Cost: about two thousand fits to a few hundred points, whatever the number of points; a tree over an eighth of them.
 */
PCL_GPF_CORE_EXPORT double
estimateNoise(PointsView points, double spacing, unsigned number_of_threads = 0);

/** \brief The same on points that are sorted already. */
PCL_GPF_CORE_EXPORT double
estimateNoise(const PointIndex& points, double spacing, unsigned number_of_threads = 0);

} // namespace pcl_gpf
