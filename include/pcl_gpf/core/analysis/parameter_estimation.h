// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/operators/gpf_parameters.h>
#include <pcl_gpf/core/operators/plane_normals.h>
#include <pcl_gpf/core/operators/quadric_fit.h>
#include <pcl_gpf/core/operators/steered_fit.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What is known of a cloud before it is filtered, in the unit of its points. */
struct CloudScale {
  double spacing = 0;  ///< estimateSpacing(), less what noise adds to it
  double noise = 0;    ///< estimateNoise(), standard deviation along the normal
  double diagonal = 0; ///< of the bounding box
  double h0 = 0;       ///< the paper's unit, diagonal / sqrt(N)
};

/** \brief Measures a cloud; where more than 2 % of the points repeat a position (invalid returns at the origin, a scan that was merged
 * with itself), spacing and noise are those of the different positions. Cost: a fraction of one filter iteration. */
PCL_GPF_CORE_EXPORT CloudScale
measureScale(PointsView points, unsigned number_of_threads = 0);

/** \brief The same on points that are sorted already. */
PCL_GPF_CORE_EXPORT CloudScale
measureScale(const PointIndex& points, unsigned number_of_threads = 0);

/** \brief Where the value of a parameter came from. */
struct ParameterOrigin {
  std::string name;   ///< field, for example "gpf.support_radius"
  double value = 0;   ///< in the unit of the points
  std::string origin; ///< "user", "estimated", "preset" or "default"
  std::string reason; ///< one phrase, for example "12 x noise"
};

/** \brief Which lengths are estimated: those of a filter that runs alone, of the two between which selectFineScale() chooses, or of the
 * one that findThinParts() asks for. */
enum class FilterScale { Single, Coarse, Fine, Finest };

/** \brief Fills every parameter that is 0 = estimated from the scale of the cloud and tells why.
 *
 * Fields that are already set stay and are reported as "user".
 */
PCL_GPF_CORE_EXPORT std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale,
                   PlaneNormalsParameters& normals,
                   BilateralNormalsParameters& bilateral,
                   GPFParameters& gpf,
                   FilterScale filter_scale = FilterScale::Single);

/** \brief The same for the fit that follows the fine scale. */
PCL_GPF_CORE_EXPORT std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, SteeredFitParameters& steered);

/** \brief The same for the quadrics of smooth parts. */
PCL_GPF_CORE_EXPORT std::vector<ParameterOrigin>
estimateParameters(const CloudScale& scale, QuadricFitParameters& quadric);

} // namespace pcl_gpf
