// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../neighborhoods.h"
#include "filter_sums.h"
#include "surface_sums.h"

#include <cstddef>
#include <cstdint>

namespace pcl_gpf {
namespace kernels {

/** Candidates of the blocks, as in Neighborhoods. */
struct Candidates {
  std::size_t query_count = 0;
  const std::size_t* run_offsets = nullptr;
  const Run* runs = nullptr;
  std::size_t absent = 0;                    ///< index of a padded datum
  const std::size_t* lane_offsets = nullptr; ///< not null: foreign lists
  const std::int32_t* lanes = nullptr;
};

/** Which children of tree nodes come near a box: bit c of near[k] is set when child c of packs[nodes[k]] is within the radius. */
struct NearChildren {
  const BoxPack* packs = nullptr;
  const std::uint32_t* nodes = nullptr;
  std::size_t count = 0;
  FloatBox box;
  float radius_sq = 0;
  std::uint8_t* near = nullptr;
};

/** The loops of one instruction set; those over pairs work on the query blocks [begin, end). */
struct KernelSet {
  void (*gaussian_sums_float)(const Candidates&, const GaussianSums<float>&, std::size_t begin, std::size_t end);
  void (*gaussian_sums_double)(const Candidates&, const GaussianSums<double>&, std::size_t begin, std::size_t end);
  void (*projection_float)(const Candidates&, const Projection<float>&, std::size_t begin, std::size_t end);
  void (*projection_double)(const Candidates&, const Projection<double>&, std::size_t begin, std::size_t end);
  void (*repulsion_float)(const Candidates&, const Repulsion<float>&, std::size_t begin, std::size_t end);
  void (*repulsion_double)(const Candidates&, const Repulsion<double>&, std::size_t begin, std::size_t end);
  void (*bilateral_normals)(const Candidates&, const BilateralNormals&, std::size_t begin, std::size_t end);
  void (*implicit_sums)(const Candidates&, const ImplicitSums&, std::size_t begin, std::size_t end);
  void (*moments)(const Candidates&, const Moments&, std::size_t begin, std::size_t end);
  void (*field_sums)(const Candidates&, const FieldSums&, std::size_t begin, std::size_t end);
  void (*side_sums)(const Candidates&, const SideSums&, std::size_t begin, std::size_t end);
  void (*widest_gaps)(const WidestGaps&);
  void (*better_gaps)(const BetterGaps&);
  void (*steered_moments)(const Candidates&, const SteeredMoments&, std::size_t begin, std::size_t end);
  void (*quadric_moments)(const Candidates&, const QuadricMoments&, std::size_t begin, std::size_t end);
  void (*near_children)(const NearChildren&);
};

/** An instruction set that this build has. */
struct KernelTarget {
  const char* name;
  std::int64_t bit; ///< Highway's
  const KernelSet* set;
};

/** All that this build has, best first. */
const KernelTarget*
builtTargets(std::size_t* count);

/** The active set (simd.cpp). */
const KernelSet&
active();

} // namespace kernels
} // namespace pcl_gpf
