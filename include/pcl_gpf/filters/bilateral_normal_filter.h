// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/filters/operator_filter.h>

namespace pcl_gpf {

/** \brief What BilateralNormalFilter did, after filter(). */
struct BilateralNormalFilterStatistics : FilterStatistics {
  BilateralNormalsStatistics normals; ///< turn of the normals in each round, isolated points
  double radius = 0;                  ///< that was used, cloud units; 0 = from the number of neighbours
  bool radius_estimated = false;
};

/** \brief Filters the normals of a cloud and keeps their jumps at sharp edges; the step before GPF.
 *
 * Huang, Wu, Gong, Cohen-Or, Ascher, Zhang, **Edge-Aware Point Set Resampling**, ACM TOG 2013, section 4: each normal
 * becomes the average of its neighbours' normals, weighted by distance and by the angle between them.
 * \code
 * pcl_gpf::estimateNormals(*cloud);                          // pcl_gpf/common/normal_estimation.h
 * pcl_gpf::BilateralNormalFilter<pcl::PointNormal> bilateral;
 * bilateral.setInputCloud(cloud);
 * bilateral.filter(*cloud);
 * \endcode
 * Only normals change, to unit length. Size, order, organisation and positions stay: unlike GPF, points that are not
 * finite stay too, as NaN, and points without a usable normal keep it. With setIndices() the output has the points of
 * the indices. By default neighbours of opposite sign are flipped before averaging, so that the normals need no
 * consistent orientation; each keeps its own sign.
 * \note Normals that are off by more than the angle are not averaged: raise setAngle() for strong noise.
 * \note In the sign-invariant form two directions are never more than 90 degrees apart: 100 count as 80.
 *
 * Cost: O(iterations * N * points in the radius) time, O(N) memory. Everything of OperatorFilter holds. Setters only
 * store; filter() checks. What each parameter means, its range and default: BilateralNormalsParameters.
 * \throws pcl::BadArgumentException, pcl::ComputeFailedException from filter(), see OperatorFilter
 * \ingroup filters
 */
template <typename PointT>
class BilateralNormalFilter : public OperatorFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<BilateralNormalFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const BilateralNormalFilter<PointT>>;
  using typename OperatorFilter<PointT>::OperatorInput;

  explicit BilateralNormalFilter(bool extract_removed_indices = false);
  ~BilateralNormalFilter() override;

  /** \brief All parameters at once. */
  void
  setParameters(const BilateralNormalsParameters& parameters);
  BilateralNormalsParameters
  getParameters() const;

  /** \brief sigma_p, cloud units; 0 = from the neighbours, or estimated when these are 0 too. Default 0. */
  void setRadius(double radius) { parameters_.radius = radius; }
  double getRadius() const { return parameters_.radius; }

  /** \brief Number of neighbours k, 0 or 3 .. 1000, the farthest of which sets the radius of each point; not together
   * with a radius. Default 0. */
  void setNeighbors(unsigned neighbors) { parameters_.neighbors = neighbors; }
  unsigned getNeighbors() const { return parameters_.neighbors; }

  /** \brief sigma_n in degrees, 0 < sigma_n <= 90. Default 30. */
  void setAngle(double degrees) { parameters_.angle = degrees; }
  double getAngle() const { return parameters_.angle; }

  /** \brief Rounds, 0 .. 1000. Default 5. */
  void setIterations(unsigned iterations) { parameters_.iterations = iterations; }
  unsigned getIterations() const { return parameters_.iterations; }

  /** \brief Flip neighbours of opposite sign before averaging. Default true. */
  void setSignInvariant(bool invariant) { parameters_.sign_invariant = invariant; }
  bool getSignInvariant() const { return parameters_.sign_invariant; }

  /** \brief What the last filter() did. */
  const BilateralNormalFilterStatistics&
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
  BilateralNormalsParameters
  effectiveParameters(const PackedCloud& cloud);

  BilateralNormalsParameters parameters_; // number_of_threads is kept by the base
  BilateralNormalFilterStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/bilateral_normal_filter.hpp>
#endif
