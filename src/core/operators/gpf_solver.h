// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../merged_points.h"
#include "../moving_neighborhoods.h"
#include "gap_rounds.h"
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
  /** One round of gap filling. */
  virtual IterationStats
  fillGaps() = 0;
  /** Frees the lists of neighbours; a further step would make them anew. */
  virtual void
  releaseNeighborhoods() = 0;
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
  IterationStats
  fillGaps() override
  {
    releaseNeighborhoods();
    return runGapRound<Real>({parameters, merged_, search_, threads_}, cloud_);
  }
  void
  releaseNeighborhoods() override;

private:
  struct DataSums; // gpf_move.cpp
  struct RepulsionSums {
    AlignedArray<Real> weight;
    SortedVectors<Real> push;
  };
  struct Step {
    Real x = 0, y = 0, z = 0;
  };
  /** Sums over samples of one iteration. */
  struct MoveSums {
    double movement = 0, longest = 0, posterior = 0, residual = 0;
    std::size_t isolated = 0;

    void
    add(const MoveSums& other)
    {
      movement += other.movement;
      longest = other.longest > longest ? other.longest : longest;
      posterior += other.posterior;
      residual += other.residual;
      isolated += other.isolated;
    }
  };

  void
  evaluateDensities();
  void
  mergeData();
  void
  evaluatePosteriorDenominators();
  kernels::Projection<Real>
  dataTerm() const;
  RepulsionSums
  evaluateRepulsion();
  bool
  isIsolated(std::size_t m, double weight) const;
  Step
  stepOf(std::size_t m, const DataSums& data, std::size_t place, const RepulsionSums& repulsion, double mu) const;
  void
  moveBlock(std::size_t begin, std::size_t end, const DataSums& data, const RepulsionSums& repulsion, MoveSums& sum);
  IterationStats
  move(const RepulsionSums& repulsion);
  IterationStats
  finishIteration(const MoveSums& total);
  double
  repulsionWeight() const;
  void
  gaussianSums(kernels::Vectors<Real> queries, std::size_t count, kernels::Vectors<Real> data,
               const Neighborhoods& neighborhoods, double radius, double falloff, AlignedArray<Real>& out) const;
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

  MergedPoints merged_; ///< data where balls hold many points; empty: the points themselves
  AlignedArray<Real> point_weight_;  ///< 1 / denominator of eq. 3, or 1
  AlignedArray<Real> inverse_density_; ///< 1 / rho_n, or 1
  MovingNeighborhoods data_neighborhoods_, posterior_neighborhoods_, repulsion_neighborhoods_;
  SoaBuffer float_samples_; ///< only for Real = double
  double variance_;
  unsigned iteration_ = 0;
};

} // namespace pcl_gpf
