// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

namespace pcl_gpf {

/** \brief Typical distance between neighbouring points: median over a sample of points of r16 sqrt(pi / 16), r16 the distance of
 * the 16th neighbour; for an even cloud of N points on an area A it is sqrt(A / N).
 *
 * Outliers and empty parts of the box do not count. Noise above half the spacing inflates it, since neighbours fill a layer and not a
 * surface: twice at three spacings; spacingWithoutNoise() takes that back.
 * \param[in] points in any one unit; the result is in the same \return 0 for fewer than 2 different points
 * Cost: at most 1,024 nearest-neighbour queries after one sort.
 */
PCL_GPF_CORE_EXPORT double
estimateSpacing(PointsView points, unsigned number_of_threads = 0);

/** \brief The same on points that are sorted already. */
PCL_GPF_CORE_EXPORT double
estimateSpacing(const PointIndex& points, unsigned number_of_threads = 0);

/** \brief The spacing of the surface's points before the noise: what estimateSpacing() finds, less what the noise adds to it.
 *
 * Exact for the median point of a flat surface with Gaussian noise along the normal, of any size; noise along the surface does not
 * matter. An error of the noise enters by half at most.
 * \param[in] apparent_spacing estimateSpacing() \param[in] noise estimateNoise(), standard deviation along the normal, same unit
 */
PCL_GPF_CORE_EXPORT double
spacingWithoutNoise(double apparent_spacing, double noise);

} // namespace pcl_gpf
