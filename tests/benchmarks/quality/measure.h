// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "figures.h"
#include "methods.h"
#include "noisy_cloud.h"

namespace pcl_gpf::quality {

/** \brief How a cloud is measured. */
struct MeasureOptions {
  std::size_t references = 200000; ///< samples of the surface for the coverage
  double edge_band = 0.02;         ///< width of the edge band, diagonals
  double away_from_edges = 10;     ///< spacings to the nearest edge or boundary of points that count for `move_away`
  double outlier_reach = 0.02;     ///< an outlier that ends this near to the surface (diagonals) counts as filtered
  unsigned threads = 0;
};

/** \brief Measures what a method made of a cloud. */
Figures
measure(const NoisyCloud& cloud, const MethodResult& result, const MeasureOptions& options);

/** \brief Mean over boundary samples of how far the outermost point lies inside the boundary, in the units of the
 * model: of all points within `window` of the sample along the boundary, the one farthest outwards; the distance of the
 * nearest point where there is none. NaN for closed surfaces. */
double
boundaryInset(const Surface& surface, const std::vector<Position>& points, double window);

} // namespace pcl_gpf::quality
