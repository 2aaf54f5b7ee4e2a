// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/operators/edge_aware_upsampling.h>
#include <pcl_gpf/core/operators/gpf_parameters.h>
#include <pcl_gpf/core/operators/plane_normals.h>
#include <pcl_gpf/core/point_index.h>

#include <cstddef>
#include <string>

namespace pcl_gpf {

/** \brief What an operator will take, estimated from a sample of the points before it starts. */
struct WorkEstimate {
  std::string parameter;     ///< the radius that the work comes from, as reports name it
  std::size_t points = 0;    ///< N
  double data_per_point = 0; ///< that a sum looks at, means of dense balls counted as one
  double pairs = 0;          ///< of all rounds or iterations
  double nominal_seconds = 0; ///< on one thread with AVX-512; decides, so that every machine refuses the same
  /** On the threads and the instruction set that it would run on; rough, within a factor of 3. */
  double seconds = 0;
  double bytes = 0;          ///< working memory; rough
};

/** \brief Work of estimatePlaneNormals(). Cost of all of them: 64 descents into the tree, below 0.1 s for a million
 * points. */
PCL_GPF_CORE_EXPORT WorkEstimate
estimateWork(const PlaneNormalsParameters& parameters, const PointIndex& points);

/** \brief Work of filterNormalsBilaterally(). \param[in] foreign_search a search of the caller's, without means */
PCL_GPF_CORE_EXPORT WorkEstimate
estimateWork(const BilateralNormalsParameters& parameters, const PointIndex& points, bool foreign_search = false);

/** \brief Work of gpfRun(), all iterations. \param[in] samples M <= N */
PCL_GPF_CORE_EXPORT WorkEstimate
estimateWork(const GPFParameters& parameters, const PointIndex& points, std::size_t samples,
             bool foreign_search = false);

/** \brief Work of upsampleEdgeAware() with a radius above 0. Of a target spacing, as of twice the points. \throws as targetCount() */
PCL_GPF_CORE_EXPORT WorkEstimate
estimateWork(const EdgeAwareUpsamplingParameters& parameters, const PointIndex& points);

/** \brief Whether the radius is taken for a mistake: a sum looks at more than 2,000 data a point and the work takes
 * more than 30 s and 0.1 ms a point, about ten times what the whole chain usually takes (docs/gpf.md). */
PCL_GPF_CORE_EXPORT bool
isExcessive(const WorkEstimate& work);

/** \throws ExcessiveWork naming parameter, pairs, seconds and megabytes if isExcessive() */
PCL_GPF_CORE_EXPORT void
refuseExcessiveWork(const WorkEstimate& work);

} // namespace pcl_gpf
