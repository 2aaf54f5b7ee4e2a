// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/operators/edge_aware_upsampling.h>

#include <pcl/surface/processing.h>

#include <cstddef>

namespace pcl_gpf {

/** \brief What EdgeAwareUpsampling did, after process(). */
struct EdgeAwareUpsamplingStatistics {
  std::size_t input_points = 0;          ///< with finite position and a normal: those between which points were inserted
  std::size_t inserted_points = 0;
  std::size_t points_without_normal = 0; ///< finite position, normal NaN or zero: kept, but nothing is inserted beside them
  std::size_t non_finite_points = 0;     ///< left out of the output
  double radius = 0;                     ///< R that was used, cloud units
  std::size_t rounds = 0;
  bool target_reached = true;            ///< false: no gap was left to fill within the radius
  double seconds = 0;                    ///< of the whole call
  bool cancelled = false;                ///< the progress callback returned false; the output is empty
};

/** \brief Makes a cloud denser and its edges sharper: fills the gaps between points, those across edges first.
  *
  * Huang, Wu, Gong, Cohen-Or, Ascher, Zhang, **Edge-Aware Point Set Resampling**, ACM TOG 2013, section 5. For clouds that
  * are clean, for example those of GPF: new points lie on the surface of the old ones, noise included.
  * \code
  * pcl_gpf::EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  * upsampling.setInputCloud(cloud);
  * upsampling.setFactor(4);
  * upsampling.process(dense);
  * \endcode
  * - The output is the finite points of setIndices() (all points by default), unchanged and in their order, then the new
  *   points, height 1. An index given twice counts once.
  * - A new point is a copy of an input point as a whole, colour, intensity and label included, with position and normal
  *   replaced: of the nearest one on the same side of the edge, so nothing is mixed across it. getCorrespondingIndices()
  *   tells which.
  * - Header and sensor pose are the input's; is_dense is set by fact. The output may be the input cloud itself.
  * - No input cloud: PCL's error message, and the output is emptied. Nothing finite: a warning, and an empty output.
  * - The object can be used again after success, cancellation and exceptions; after the latter two the output is empty
  *   (a cloud that is the input stays after an exception).
  *
  * \note Normals need no consistent orientation by default; where the sheets of a body lie closer than two spacings they
  * do: orient them and call setSignInvariant(false).
  * \throws pcl::BadArgumentException if a parameter or an index is out of range, the target lies below the number of input
  * points, or no point has a usable normal; pcl::ComputeFailedException if fewer than 3 points are usable, they lie on one
  * line, or the work would be excessive. All before the work begins.
  * Cost: linear in the points of the output. Thread safety: one object, one thread at a time; the result does not depend
  * on the number of threads. What each parameter means, its range and default: EdgeAwareUpsamplingParameters.
  * \ingroup surface
  */
template <typename PointT>
class EdgeAwareUpsampling : public pcl::CloudSurfaceProcessing<PointT, PointT> {
  static_assert(pcl::traits::has_xyz_v<PointT> && pcl::traits::has_normal_v<PointT>,
                "pcl_gpf::EdgeAwareUpsampling needs a point type with xyz and normal fields, for example pcl::PointNormal; "
                "copy the cloud into one with pcl::copyPointCloud() and fill the normals with pcl_gpf::estimateNormals()");

public:
  using Ptr = pcl::shared_ptr<EdgeAwareUpsampling<PointT>>;
  using ConstPtr = pcl::shared_ptr<const EdgeAwareUpsampling<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief All parameters at once; lengths in cloud units. */
  void setParameters(const EdgeAwareUpsamplingParameters& parameters) { parameters_ = parameters; }
  const EdgeAwareUpsamplingParameters& getParameters() const { return parameters_; }

  /** \brief Points in all, those of the input included; the other two targets are cleared. */
  void setTargetCount(std::size_t count) { setTarget(count, 0.0, 0.0); }
  /** \brief Points in all as a multiple of the usable input, 1 .. 1000; the other two targets are cleared. Default 2. */
  void setFactor(double factor) { setTarget(0, factor, 0.0); }
  /** \brief Distance of neighbours to fill up to, cloud units; the other two targets are cleared. */
  void setSpacing(double spacing) { setTarget(0, 0.0, spacing); }

  /** \brief R, cloud units; 0 = 3 times the spacing of the input. Default 0. */
  void setRadius(double radius) { parameters_.radius = radius; }
  /** \brief sigma_n in degrees, 0 < sigma_n <= 90. Default 30. */
  void setAngle(double degrees) { parameters_.angle = degrees; }
  /** \brief rho, 0 (evenly) .. 10 (edges first). Default 5. */
  void setEdgeSensitivity(double exponent) { parameters_.edge_sensitivity = exponent; }
  /** \brief Align the normals of each pair before they are compared. Default true. */
  void setSignInvariant(bool invariant) { parameters_.sign_invariant = invariant; }
  /** \brief Threads; 0 = all that the process may use. Default 0. */
  void setNumberOfThreads(unsigned threads) { parameters_.number_of_threads = threads; }

  /** \brief Called with the fraction done, from the calling thread; if it returns false, process() prints a warning and
    * leaves an empty output, and getStatistics().cancelled is true. Default none. */
  void setProgressCallback(const ProgressCallback& callback) { progress_ = callback; }

  void
  process(PointCloud& output) override;

  /** \brief After process(): for each output point the input index of the point that it is, or was copied from. */
  const pcl::Indices& getCorrespondingIndices() const { return corresponding_; }

  /** \brief What the last process() did. */
  const EdgeAwareUpsamplingStatistics& getStatistics() const { return statistics_; }

protected:
  void
  performProcessing(PointCloud& output) override;

private:
  void
  setTarget(std::size_t count, double factor, double spacing)
  {
    parameters_.target_count = count;
    parameters_.factor = factor;
    parameters_.spacing = spacing;
  }
  EdgeAwareUpsamplingParameters
  localParameters(const PackedCloud& packed) const;
  void
  writeInput(const PackedCloud& packed, PointCloud& output);
  void
  writeInserted(const PackedCloud& packed, const EdgeAwareUpsamplingResult& result, PointCloud& output);

  EdgeAwareUpsamplingParameters parameters_;
  ProgressCallback progress_;
  pcl::Indices corresponding_;
  EdgeAwareUpsamplingStatistics statistics_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/surface/impl/edge_aware_upsampling.hpp>
#endif
