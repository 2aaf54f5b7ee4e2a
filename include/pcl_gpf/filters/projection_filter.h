// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/filters/operator_filter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Base of filters that project points X onto the surface of a cloud V: OperatorFilter and the choice of X^0.
 *
 * X^0 is, in this order of precedence: the points of setSampleIndices(); a seeded random share of V when
 * setSampleRatio() is below 1; every point. In the last case points without a normal are kept where they are, and those
 * that are not finite are removed, unless the cloud is organised and no indices were set.
 * A new filter gives a parameter struct, checkParameters(), clearStatistics() and runOperator(); GPF is the model.
 */
template <typename PointT>
class ProjectionFilter : public OperatorFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<ProjectionFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ProjectionFilter<PointT>>;

  ~ProjectionFilter() override;

  /** \brief X^0 as indices into the input cloud; the output has their order. Empty = by ratio. Default empty.
   *
   * Each must be among setIndices() and have a finite position and a usable normal, else filter() throws
   * pcl::BadArgumentException; one given twice counts once. getSampleIndices() tells what the last filter() used.
   */
  void
  setSampleIndices(const pcl::Indices& indices);

  /** \brief Share of V that seeds X^0, 0 < ratio <= 1. Default 1: every point, in order. At least one point is taken.
   */
  void
  setSampleRatio(double ratio);
  double
  getSampleRatio() const;

  /** \brief Seed of that random choice. Default 0. The same seed gives the same choice everywhere. */
  void
  setSeed(std::uint64_t seed);
  std::uint64_t
  getSeed() const;

protected:
  ProjectionFilter(const std::string& name, bool extract_removed_indices);

  std::vector<std::uint32_t>
  keptPoints(const PackedCloud& packed) const final;

private:
  std::vector<std::uint32_t>
  everyPoint(const PackedCloud& packed) const;
  std::vector<std::uint32_t>
  randomSamples(const PackedCloud& packed) const;
  std::vector<std::uint32_t>
  explicitSamples(const PackedCloud& packed) const;

  pcl::Indices requested_samples_;
  double sample_ratio_ = 1.0;
  std::uint64_t seed_ = 0;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/projection_filter.hpp>
#endif
