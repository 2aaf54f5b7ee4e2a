// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sparse_lattice.h"

#include <pcl_gpf/core/marching_cubes.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Finds the cells that the surface crosses: from those of the seeds across every face with both signs. */
class SurfaceFollower {
public:
  SurfaceFollower(const MarchingCubesParameters& parameters, const ImplicitFunction& function);

  /** \brief Runs to the end. \throws ExcessiveWork, Cancelled */
  void
  follow(PointsView seeds, const ProgressCallback& progress);

  /** \brief Keys of the crossed cells, ascending. */
  const std::vector<std::uint64_t>& cells() const { return cells_; }
  SparseLattice& lattice() { return lattice_; }
  const MarchingCubesStatistics& statistics() const { return statistics_; }
  /** \brief Position of a corner, with a share of a cell added along one axis. */
  std::array<float, 3>
  position(LatticePoint corner, unsigned axis = 0, double share = 0.0) const;

private:
  std::vector<std::uint64_t>
  seedCells(PointsView seeds) const;
  /** Marks a cell as visited; \return whether it was not before */
  bool
  visit(LatticePoint cell);
  void
  evaluateCorners(const std::vector<std::uint64_t>& cells);
  void
  evaluate(std::vector<std::uint64_t>& corners);
  /** Keeps the crossed ones of `cells` and appends their neighbours to `next`. */
  void
  crossCells(const std::vector<std::uint64_t>& cells, std::vector<std::uint64_t>& next);
  void
  markEdges(const std::array<CornerFinder::Corner, 8>& corners, unsigned signs);
  void
  checkMemory(std::size_t waiting) const;

  MarchingCubesParameters parameters_;
  const ImplicitFunction& function_;
  SparseLattice lattice_;
  std::vector<std::uint64_t> cells_;
  MarchingCubesStatistics statistics_;
};

} // namespace pcl_gpf
