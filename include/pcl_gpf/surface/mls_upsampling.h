// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/surface/mls_points.h>

#include <pcl/surface/processing.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief What MLSUpsampling did, after process(). */
struct MLSUpsamplingStatistics {
  std::size_t input_points = 0;      ///< finite points
  std::size_t non_finite_points = 0; ///< left out
  std::size_t output_points = 0;
  double radius = 0;                 ///< of the neighbourhoods, cloud units
  double seconds = 0;                ///< of the whole call
};

/** \brief PCL's moving least squares with its ways of upsampling, made repeatable.
  *
  * pcl::MovingLeastSquares does the fits; around it, what its users trip over is mended:
  * - The output is in the order of the input, with any number of threads, and the same bits in every run; the random mode
  *   takes a seed. 0 threads means all, as everywhere else in PCL.
  * - Sensor pose and header are the input's, is_dense is set by fact, height is 1; every field of the input point is kept.
  * - Normals are set, unit length, and turned to the side of the input point's normal, or where it has none, towards the
  *   sensor origin.
  * - Points without three neighbours, which PCL drops without a word, are told by getDroppedIndices() and a warning.
  *   getCorrespondingIndices() has the input point of every output point.
  * - Far from the origin no digits are lost: the fits are made about the centre of the cloud.
  * - No input cloud: an error message and an empty output, where PCL crashes. The output may be the input cloud itself.
  * - The size of the output is foreseen; 100 million points and more are refused before the work begins, and so is a radius
  *   whose fits take minutes.
  *
  * \note Moving least squares round sharp edges off; EdgeAwareUpsampling keeps them. The input itself is smoothed too: what comes
  * out are points of the fitted surface, not the input points and others.
  * \code
  * pcl_gpf::MLSUpsampling<pcl::PointNormal> mls;
  * mls.setInputCloud(cloud);
  * mls.setMethod(pcl_gpf::MLSMethod::VoxelGridDilation);
  * mls.process(dense);
  * \endcode
  * \throws pcl::BadArgumentException if a parameter or an index is out of range, pcl::ComputeFailedException if fewer than 3
  * points are finite, all coincide, the extent is below 1e-15 or above 1e15, or the work would be excessive
  * Cost: PCL's; about 20 us a point. Thread safety: one object, one thread at a time. What each parameter means, its range and
  * default: MLSUpsamplingParameters.
  * \ingroup surface
  */
template <typename PointT>
class MLSUpsampling : public pcl::CloudSurfaceProcessing<PointT, PointT> {
  static_assert(pcl::traits::has_xyz_v<PointT> && pcl::traits::has_normal_v<PointT>,
                "pcl_gpf::MLSUpsampling needs a point type with xyz and normal fields, for example pcl::PointNormal");

public:
  using Ptr = pcl::shared_ptr<MLSUpsampling<PointT>>;
  using ConstPtr = pcl::shared_ptr<const MLSUpsampling<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief All parameters at once; lengths in cloud units. */
  void setParameters(const MLSUpsamplingParameters& parameters) { parameters_ = parameters; }
  const MLSUpsamplingParameters& getParameters() const { return parameters_; }
  /** \brief Which points are put out. Default MLSMethod::VoxelGridDilation. */
  void setMethod(MLSMethod method) { parameters_.method = method; }
  /** \brief Radius of the neighbourhoods, cloud units; 0 = 4 times the spacing. Default 0. */
  void setSearchRadius(double radius) { parameters_.radius = radius; }
  /** \brief Degree of the polynomials, 0 .. 5. Default 2. */
  void setPolynomialOrder(unsigned order) { parameters_.order = order; }
  /** \brief Seed of MLSMethod::RandomUniformDensity. Default 1. */
  void setSeed(std::uint64_t seed) { parameters_.seed = seed; }
  /** \brief Threads; 0 = all that the process may use. Default 0. */
  void setNumberOfThreads(unsigned threads) { parameters_.number_of_threads = threads; }

  void
  process(PointCloud& output) override;

  /** \brief After process(): for each output point the input index of the point whose surface it lies on. */
  const pcl::Indices& getCorrespondingIndices() const { return corresponding_; }
  /** \brief After process(): finite input points that have fewer than 3 neighbours and made no surface, ascending. */
  const pcl::Indices& getDroppedIndices() const { return dropped_; }
  /** \brief What the last process() did. */
  const MLSUpsamplingStatistics& getStatistics() const { return statistics_; }

protected:
  void
  performProcessing(PointCloud& output) override;

private:
  MLSUpsamplingParameters parameters_;
  pcl::Indices corresponding_;
  pcl::Indices dropped_;
  MLSUpsamplingStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/surface/impl/mls_upsampling.hpp>
#endif
