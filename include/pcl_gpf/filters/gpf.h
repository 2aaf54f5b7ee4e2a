// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/gpf_parameters.h>
#include <pcl_gpf/filters/projection_filter.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief What GPF did, after filter(). */
struct GPFStatistics : FilterStatistics {
  std::vector<IterationStats> iterations; ///< variance in the normalised frame, movements in cloud units
  std::vector<IterationStats> gap_iterations; ///< rounds of gap filling: movements in cloud units, seconds
  std::size_t isolated_points = 0;        ///< points of X whose only data in the last iteration were their own seeds
  double support_radius = 0;              ///< h that was used, cloud units
  bool support_radius_estimated = false;
};

/** \brief Moves the points of a noisy cloud onto its underlying surface and keeps sharp features.
 *
 * Lu, Wu, Chen, Yeung, Chen, Zwicker, **GPF: GMM-inspired Feature-preserving Point Set Filtering**, TVCG 2017; equation
 * numbers in this library are the paper's. Normals should be filtered first, by BilateralNormalFilter. Their signs do
 * not matter.
 * \code
 * pcl_gpf::GPF<pcl::PointNormal> gpf;
 * gpf.setInputCloud(cloud);
 * gpf.filter(*cloud);
 * \endcode
 * The default is a filter: every point is kept, in order; it moves along normals only (no repulsion); sigma^2 stays at
 * (h / 2)^2; the planes of both points of a pair pull (DataTerm::Symmetric), which does not inflate curved parts; input
 * points of another normal direction pull less, which keeps points from piling up on edges; h comes from the noise and
 * the spacing of the cloud. setParameters(GPFParameters::paper()) is the paper's Algorithm 1 instead, which resamples
 * half of the points.
 * \note Algorithm 1 with its literal eq. 11 hardly filters: sigma^2 comes from distances along one normal but is
 * divided by d = 3, so it shrinks about threefold a round, each point clings to its nearest neighbour and the noise
 * stays (on a cube with 1 % noise the mean error goes from 0.79 % of the diagonal to 0.80 %; with sigma fixed to 0.19
 * %). Use it to reproduce the paper.
 * \note Sheets closer together than h / 2 are drawn together, and open borders shrink a little: set a smaller
 * support radius then.
 *
 * Cost: O(iterations * (N + M) * points in the ball h / 2) time, O(N + M) memory. Everything of OperatorFilter and
 * ProjectionFilter holds. Setters only store; filter() checks. What each parameter means, its range and default:
 * GPFParameters.
 * \throws pcl::BadArgumentException, pcl::ComputeFailedException from filter(), see OperatorFilter
 * \ingroup filters
 */
template <typename PointT>
class GPF : public ProjectionFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<GPF<PointT>>;
  using ConstPtr = pcl::shared_ptr<const GPF<PointT>>;
  using typename OperatorFilter<PointT>::OperatorInput;

  explicit GPF(bool extract_removed_indices = false);
  ~GPF() override;

  /** \brief All parameters at once; explicit sample indices stay. */
  void
  setParameters(const GPFParameters& parameters);
  GPFParameters
  getParameters() const;

  /** \brief h (eq. 6), cloud units; 0 = estimated. Default 0. */
  void setSupportRadius(double radius) { parameters_.support_radius = radius; }
  double getSupportRadius() const { return parameters_.support_radius; }

  /** \brief mu-hat (eq. 10), 0 .. 0.5. Default 0. */
  void setRepulsionWeight(double weight) { parameters_.repulsion_weight = weight; }
  double getRepulsionWeight() const { return parameters_.repulsion_weight; }

  /** \brief omega (eq. 1), 0 <= omega < 1. Default 0.02. \note No effect without posterior normalisation. */
  void setOutlierWeight(double weight) { parameters_.outlier_weight = weight; }
  double getOutlierWeight() const { return parameters_.outlier_weight; }

  /** \brief sigma^2 of the first iteration, normalised frame (box diagonal 1); 0 = (h / 2)^2. Default 0. */
  void setInitialVariance(double variance) { parameters_.initial_variance = variance; }
  double getInitialVariance() const { return parameters_.initial_variance; }

  /** \brief How sigma^2 goes on (eq. 11). Default VarianceUpdate::Fixed. */
  void setVarianceUpdate(VarianceUpdate update) { parameters_.variance_update = update; }
  VarianceUpdate getVarianceUpdate() const { return parameters_.variance_update; }

  /** \brief Which planes pull (eq. 5). Default DataTerm::Symmetric. */
  void setDataTerm(DataTerm term) { parameters_.data_term = term; }
  DataTerm getDataTerm() const { return parameters_.data_term; }

  /** \brief Whether weights are posteriors (eq. 3). Default false. */
  void setPosteriorNormalization(bool normalize) { parameters_.posterior_normalization = normalize; }
  bool getPosteriorNormalization() const { return parameters_.posterior_normalization; }

  /** \brief Density weights rho_n and w_m (eq. 10). Default false. */
  void setDensityWeights(bool use) { parameters_.density_weights = use; }
  bool getDensityWeights() const { return parameters_.density_weights; }

  /** \brief sigma_d in degrees, 0 < sigma_d <= 90; 90 = normals do not weigh. Default 45. */
  void setNormalAngle(double degrees) { parameters_.normal_angle = degrees; }
  double getNormalAngle() const { return parameters_.normal_angle; }

  /** \brief Share of the data weight that does not depend on normals, 0 .. 1. Default 0.15. */
  void setNormalWeightFloor(double share) { parameters_.normal_weight_floor = share; }
  double getNormalWeightFloor() const { return parameters_.normal_weight_floor; }

  /** \brief Repulsion within the sample's own tangent plane too, and none at the end. Default true. */
  void setOwnTangentRepulsion(bool own) { parameters_.own_tangent_repulsion = own; }
  bool getOwnTangentRepulsion() const { return parameters_.own_tangent_repulsion; }

  /** \brief Largest number of iterations, 0 .. 10000. Default 5. */
  void setMaximumIterations(unsigned iterations) { parameters_.maximum_iterations = iterations; }
  unsigned getMaximumIterations() const { return parameters_.maximum_iterations; }

  /** \brief Rounds after the iterations in which points piled up on edges spread over the bands that they left empty (paper,
   * Fig. 21); 0 .. 100. Default 0. */
  void setGapIterations(unsigned rounds) { parameters_.gap_iterations = rounds; }
  unsigned getGapIterations() const { return parameters_.gap_iterations; }

  /** \brief How far from an edge they may spread, in h / 2; 1 .. 8. Default 2. */
  void setGapRadiusFactor(double factor) { parameters_.gap_radius_factor = factor; }
  double getGapRadiusFactor() const { return parameters_.gap_radius_factor; }

  /** \brief Stops when the mean movement of an iteration is below this share of h; 0 = never. Default 1e-4. */
  void setConvergenceThreshold(double share) { parameters_.convergence_threshold = share; }
  double getConvergenceThreshold() const { return parameters_.convergence_threshold; }

  /** \brief What the last filter() did. */
  const GPFStatistics&
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
  GPFParameters
  effectiveParameters(const PackedCloud& cloud);

  GPFParameters parameters_; // sample_ratio, seed and number_of_threads are kept by the bases
  GPFStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/gpf.hpp>
#endif
