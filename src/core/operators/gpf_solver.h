// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "gpf_points.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/operators/gpf.h>

#include <vector>

namespace pcl_gpf {

/** What GPFState hides: the recursion in float, or in double where the paper's own recursion is asked for. */
struct GPFState::Implementation {
  GPFParameters parameters;

  virtual ~Implementation() = default;
  virtual IterationStats
  step() = 0;
  virtual std::size_t
  size() const = 0;
  virtual void
  positions(MutableVectorsView out) const = 0;
  virtual void
  displacements(MutableVectorsView out) const = 0;
  virtual void
  normals(MutableVectorsView out) const = 0;
  virtual std::vector<std::uint8_t>
  isolated() const = 0;
};

/** Candidates that stay valid while points move less than a slack. */
class MovingNeighborhoods {
public:
  /** \param[in] moving_sides 1 if only queries or only data move, 2 if both do */
  MovingNeighborhoods(double radius, double moving_sides) : radius_(radius), moving_sides_(moving_sides) {}

  bool stale() const { return !built_ || moving_sides_ * moved_ > slack(); }
  double reach() const { return radius_ + slack(); }
  void
  set(Neighborhoods neighborhoods)
  {
    neighborhoods_ = std::move(neighborhoods);
    built_ = true;
    moved_ = 0.0;
  }
  void addMovement(double longest) { moved_ += longest; }
  const Neighborhoods& get() const { return neighborhoods_; }

private:
  /** A tenth of the radius: about 20 % more candidates against lists built anew in every iteration. */
  double slack() const { return 0.1 * radius_; }

  double radius_;
  double moving_sides_;
  double moved_ = 0.0;
  bool built_ = false;
  Neighborhoods neighborhoods_;
};

/** The recursion of Algorithm 1 on points sorted along a Hilbert curve. */
template <typename Real>
class GPFSolver : public GPFState::Implementation {
public:
  GPFSolver(const GPFParameters& p, const GPFInput& input);

  IterationStats
  step() override;
  std::size_t
  size() const override
  {
    return cloud_.sampleCount();
  }
  void
  positions(MutableVectorsView out) const override
  {
    cloud_.positions(out);
  }
  void
  displacements(MutableVectorsView out) const override
  {
    cloud_.displacements(out);
  }
  void
  normals(MutableVectorsView out) const override
  {
    cloud_.normals(out);
  }
  std::vector<std::uint8_t>
  isolated() const override;

private:
  struct DataSums;
  struct RepulsionSums;

  void
  evaluateDensities();
  void
  evaluatePosteriorDenominators();
  DataSums
  evaluateDataTerm();
  RepulsionSums
  evaluateRepulsion();
  IterationStats
  move(const DataSums& data, const RepulsionSums& repulsion);
  double
  repulsionWeight() const;
  void
  gaussianSums(kernels::Vectors<Real> queries, std::size_t count, kernels::Vectors<Real> data, const Neighborhoods& neighborhoods,
               double radius, double falloff, AlignedArray<Real>& out) const;
  Neighborhoods
  neighborhoods(const ClusterTree& tree, PointsView data, PointsView queries, double reach) const;
  const Neighborhoods&
  current(MovingNeighborhoods& moving, bool data_are_samples, bool queries_are_samples);

  NeighborSearch search_;
  GPFPoints<Real> cloud_;
  std::size_t threads_;
  double data_radius_; ///< h / 2

  ClusterTree sample_tree_;
  std::vector<std::uint8_t> isolated_; ///< in sorted order

  AlignedArray<Real> point_weight_;  ///< 1 / denominator of eq. 3, or 1
  AlignedArray<Real> inverse_density_; ///< 1 / rho_n, or 1
  MovingNeighborhoods data_neighborhoods_, posterior_neighborhoods_, repulsion_neighborhoods_;
  SoaBuffer float_samples_; ///< only for Real = double
  double variance_;
  unsigned iteration_ = 0;
};

} // namespace pcl_gpf
