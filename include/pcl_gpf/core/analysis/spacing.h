// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Typical distance between neighbouring points: median over a sample of points of r16 sqrt(pi / 16), r16 the distance of
 * the 16th neighbour; for an even cloud of N points on an area A it is sqrt(A / N).
 *
 * Outliers and empty parts of the box do not count; noise above half the spacing inflates it by up to a third.
 * \param[in] points in any one unit; the result is in the same \return 0 for fewer than 2 different points
 * Cost: at most 4,096 nearest-neighbour queries after one sort.
 */
PCL_GPF_CORE_EXPORT double
estimateSpacing(PointsView points, unsigned number_of_threads = 0);

/** \brief The same on points that are sorted already. */
PCL_GPF_CORE_EXPORT double
estimateSpacing(const PointIndex& points, unsigned number_of_threads = 0);

} // namespace pcl_gpf
