// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/filters/projection_filter.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief What RIMLSProjection did, after filter(). Lengths in cloud units. */
struct RIMLSProjectionStatistics : FilterStatistics {
  RimlsProjectionStatistics projection;
  double spacing = 0;        ///< of the points
  double support_radius = 0; ///< median h_i
};

/** \brief Moves the points of a cloud onto the implicit surface that they and their normals define; sharp features stay.
 *
 * Oeztireli, Guennebaud, Gross, **Feature Preserving Point Set Surfaces based on Non-Linear Kernel Regression**,
 * Eurographics 2009: robust implicit moving least squares. Normals become the gradient of the implicit function.
 * \code
 * pcl_gpf::RIMLSProjection<pcl::PointNormal> rimls; // cloud: normals filtered and oriented consistently
 * rimls.setInputCloud(cloud);
 * rimls.filter(*cloud);
 * \endcode
 * The formulas, parameters and stopping rules are those of MeshLab's "MLS projection (RIMLS)". Points move along the
 * gradient only. A point outside the domain (fewer than 4 samples reach it, or none is near) stays where it is.
 * \note Normals must be oriented consistently: where they are not, the signed distances cancel. If a tenth of them or
 * more contradict their neighbours, filter() throws pcl::BadArgumentException; setCheckOrientation() leaves that out.
 * \note On convex parts points move outward by about h^2 / (12 R): keep the support small against radii of curvature.
 *
 * Cost: O(steps * fits * N * points in the support) time, O(N) memory. Everything of OperatorFilter and
 * ProjectionFilter holds. Setters only store; filter() checks. What each parameter means, its range and default:
 * RimlsParameters.
 * \throws pcl::BadArgumentException, pcl::ComputeFailedException from filter(), see OperatorFilter
 * \ingroup filters
 */
template <typename PointT>
class RIMLSProjection : public ProjectionFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<RIMLSProjection<PointT>>;
  using ConstPtr = pcl::shared_ptr<const RIMLSProjection<PointT>>;
  using typename OperatorFilter<PointT>::OperatorInput;

  explicit RIMLSProjection(bool extract_removed_indices = false);
  ~RIMLSProjection() override;

  /** \brief All parameters at once; those of the choice of samples stay. */
  void
  setParameters(const RimlsParameters& parameters);
  RimlsParameters
  getParameters() const;

  /** \brief Support radius in local radii (half the distance of the 16th neighbour), 1 .. 100. Default 4. */
  void setScale(double scale) { parameters_.scale = scale; }
  double getScale() const { return parameters_.scale; }

  /** \brief Support radius of all samples instead, cloud units; 0 = from the scale. Default 0. */
  void setSupportRadius(double radius) { parameters_.radius = radius; }
  double getSupportRadius() const { return parameters_.radius; }

  /** \brief sigma_n, weight of normals, 0.001 .. 1e6: 0.5 sharp, 1.5 smooth. Default 0.75. */
  void setSigmaN(double sigma) { parameters_.sigma_n = sigma; }
  double getSigmaN() const { return parameters_.sigma_n; }

  /** \brief sigma_r, weight of residuals, as a share of h, 0.001 .. 1e6; 0 = off, as in MeshLab. Default 0. */
  void setSigmaR(double sigma) { parameters_.sigma_r = sigma; }
  double getSigmaR() const { return parameters_.sigma_r; }

  /** \brief Fits of each value, the first of them plain, 1 .. 100. Default 3. */
  void setFits(unsigned fits) { parameters_.fits = fits; }
  unsigned getFits() const { return parameters_.fits; }

  /** \brief Largest number of steps, 1 .. 1000. Default 15. */
  void setMaximumIterations(unsigned iterations) { parameters_.maximum_iterations = iterations; }
  unsigned getMaximumIterations() const { return parameters_.maximum_iterations; }

  /** \brief Whether filter() refuses normals without consistent orientation. Default true; costs a neighbour search. */
  void setCheckOrientation(bool check) { check_orientation_ = check; }
  bool getCheckOrientation() const { return check_orientation_; }

  /** \brief What the last filter() did. */
  const RIMLSProjectionStatistics&
  getStatistics() const
  {
    return statistics_;
  }

protected:
  FilterStatistics&
  clearStatistics() override;
  void
  checkParameters() const override;
  void
  runOperator(const OperatorInput& input, MutableVectorsView displacements, MutableVectorsView normals) override;

private:
  RimlsParameters parameters_; // number_of_threads is kept by the base
  bool check_orientation_ = true;
  RIMLSProjectionStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/rimls_projection.hpp>
#endif
