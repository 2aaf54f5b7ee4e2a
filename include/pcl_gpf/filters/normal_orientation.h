// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/filters/operator_filter.h>

#include <array>

namespace pcl_gpf {

/** \brief What NormalOrientation did, after filter(). */
struct NormalOrientationFilterStatistics : FilterStatistics {
  NormalOrientationStatistics orientation; ///< parts, flipped normals, votes; noise in cloud units
};

/** \brief Gives the normals of a cloud consistent signs; what upsampling and surface reconstruction need.
 *
 * Hoppe et al., **Surface Reconstruction from Unorganized Points**, SIGGRAPH 1992, with votes instead of single edges:
 * see orientNormals().
 * \code
 * pcl_gpf::NormalOrientation<pcl::PointNormal> orientation; // after BilateralNormalFilter
 * orientation.setInputCloud(cloud);
 * orientation.filter(*cloud);
 * \endcode
 * Only signs change (and lengths, to 1). Size, order, organisation and positions stay: points that are not finite stay
 * too, as NaN, and points without a usable normal keep it. With setIndices() the output has the points of the indices.
 * Each connected part is turned toward the view point if there is one and the part faces it; closed parts are turned
 * outward; the rest so that the highest point looks up. By default no view point is assumed, since a cloud without a
 * sensor has its origin at 0 as well.
 *
 * Cost: O(N) beyond N queries of k neighbours, O(N k) memory. Everything of OperatorFilter holds, except that a search
 * method is only checked: the k nearest neighbours are always found by the built-in tree. Setters only store; filter()
 * checks. What each parameter means, its range and default: NormalOrientationParameters.
 * \throws pcl::BadArgumentException, pcl::ComputeFailedException from filter(), see OperatorFilter
 * \ingroup filters
 */
template <typename PointT>
class NormalOrientation : public OperatorFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<NormalOrientation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const NormalOrientation<PointT>>;
  using typename OperatorFilter<PointT>::OperatorInput;

  explicit NormalOrientation(bool extract_removed_indices = false);
  ~NormalOrientation() override;

  /** \brief All parameters at once. */
  void
  setParameters(const NormalOrientationParameters& parameters);
  NormalOrientationParameters
  getParameters() const;

  /** \brief Number of neighbours k that vote, 3 .. 100. Default 16. */
  void setNeighbors(unsigned neighbors) { parameters_.neighbors = neighbors; }
  unsigned getNeighbors() const { return parameters_.neighbors; }

  /** \brief Noise along the normals, cloud units; 0 = estimated. Default 0. */
  void setNoise(double noise) { parameters_.noise = noise; }
  double getNoise() const { return parameters_.noise; }

  /** \brief Gap in spacings across which parts still vote, 0 .. 100. Default 6. */
  void setGap(double spacings) { parameters_.gap = spacings; }
  double getGap() const { return parameters_.gap; }

  /** \brief Turn parts toward this point, cloud units; must be finite. */
  void
  setViewPoint(double x, double y, double z)
  {
    view_point_ = {x, y, z};
    view_point_source_ = ViewPointSource::Given;
  }
  /** \brief Turn parts toward the cloud's sensor_origin_. */
  void useSensorOriginAsViewPoint() { view_point_source_ = ViewPointSource::SensorOrigin; }
  /** \brief No view point, the default. */
  void clearViewPoint() { view_point_source_ = ViewPointSource::None; }
  /** \brief Whether filter() will turn parts toward a view point. */
  bool hasViewPoint() const { return view_point_source_ != ViewPointSource::None; }

  /** \brief What the last filter() did. */
  const NormalOrientationFilterStatistics&
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
  enum class ViewPointSource { None, Given, SensorOrigin };

  std::array<double, 3>
  worldViewPoint() const;

  NormalOrientationParameters parameters_; // number_of_threads is kept by the base
  std::array<double, 3> view_point_{0.0, 0.0, 0.0};
  ViewPointSource view_point_source_ = ViewPointSource::None;
  NormalOrientationFilterStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/normal_orientation.hpp>
#endif
