// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../neighborhoods.h"
#include "gaps.h"

#include <cstddef>
#include <cstdint>

namespace pcl_gpf {

/** What the wide loops see: raw pointers and numbers only. Every array of queries is padded to a multiple of 16. Every array of data
 * has a padded element behind its end, which stands for no datum (Candidates::absent); its position is far beyond any radius.
 * Positions of data and `inverse_sq_per_datum` are loaded by whole vectors that begin anywhere in a run, so up to 15 elements behind
 * the end are read and left unused: these arrays have 15 padded elements, of any value. */
namespace kernels {

template <typename Real>
struct Vectors {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
};

template <typename Real>
struct MutableVectors {
  Real* x = nullptr;
  Real* y = nullptr;
  Real* z = nullptr;

  operator Vectors<Real>() const { return {x, y, z}; }
};

/** Radius of the open ball: one for all, one a query, or one a datum. */
template <typename Real>
struct Radius {
  Real radius_sq = 0;
  const Real* per_query = nullptr;
  const Real* inverse_sq_per_datum = nullptr; ///< 1 / radius^2; padded like the data; the fields above are not read then
};

/** out[q] = sum over data in reach of exp(-falloff r^2 / radius^2). Eq. 3's denominators, rho and w. */
template <typename Real>
struct GaussianSums {
  Vectors<Real> queries, data;
  Radius<Real> radius;
  Real falloff = 0;
  Real* out = nullptr;
};

/** Sums of eqs. 10 and 11 over the data in reach of each query; weight = posterior / density, posterior = exp(-falloff r^2 /
 * radius^2) * data_weight, d = v_n - x_m. */
template <typename Real>
struct Projection {
  Vectors<Real> queries, query_normals, data, data_normals;
  Radius<Real> radius;
  Real falloff = 0;
  bool symmetric = false;          ///< DataTerm::Symmetric
  Real symmetry_falloff = 0;       ///< 1 / (1 - cos angle) of the share that the query's own plane gets
  bool normal_weights = false;
  Real normal_falloff = 0;         ///< 1 / (1 - cos normal_angle)
  Real normal_floor = 0;
  const Real* data_weight = nullptr;  ///< 1 / denominator of eq. 3, or the number of merged points; null, with density null: all 1
  const Real* data_density = nullptr; ///< 1 / rho; null: all 1
  std::size_t first_output = 0;       ///< query whose results go to the first place of the arrays below
  Real* weight_sum = nullptr;         ///< sum of weights
  MutableVectors<Real> pull;          ///< sum of weight * (d.n) n
  bool variance = false;              ///< also the sums of eq. 11; needs data_weight
  Real* posterior_sum = nullptr;
  Real* residual_sq = nullptr;        ///< sum of posterior (d.b)^2
  MutableVectors<Real> cross;         ///< sum of posterior (d.b) b
  MutableVectors<Real> scatter_diagonal; ///< sum of posterior b b^T: xx yy zz
  MutableVectors<Real> scatter_mixed;    ///< yz xz xy
};

/** Sums of the repulsion of eq. 10: push = sum of w theta(r) t / r, weight_sum = sum of w theta(r) / r with t = (I - b b^T) d, r = |t|. */
template <typename Real>
struct Repulsion {
  Vectors<Real> queries, data, data_normals;
  Radius<Real> radius;
  Real falloff = 0;          ///< theta(r) = exp(-falloff r^2 / radius^2)
  Real shortest = 0;         ///< r is taken as at least this in the division
  const Real* data_weight = nullptr; ///< w; null: 1
  MutableVectors<Real> push;
  Real* weight_sum = nullptr;
};

/** One round of the bilateral normal filter: out = sum of theta psi n (not normalised). */
struct BilateralNormals {
  Vectors<float> queries, query_normals, data, data_normals;
  Radius<float> radius;
  float falloff = 1;       ///< theta(r) = exp(-falloff r^2 / radius^2)
  float angle_falloff = 0; ///< 1 / (1 - cos sigma_n)
  bool sign_invariant = true;
  const float* data_weight = nullptr; ///< null: all 1
  MutableVectors<float> out;
};

/** Sums of one RIMLS fit over the data that reach the query: u = x - p, f_i = u.n, t = 1 - u^2 / h_i^2, w = t^4 v, where v is 1 in the
 * plain fit and exp(-normal_falloff |n - gradient|^2 - residual_falloff (f_i - value)^2 / h_i^2) in a robust one. */
struct ImplicitSums {
  Vectors<float> queries, data, data_normals;
  Radius<float> radius;         ///< per datum
  bool robust = false;
  const float* value = nullptr; ///< of the fit before, for robust fits; so is `gradient`
  Vectors<float> gradient;
  float normal_falloff = 0;
  float residual_falloff = 0;
  std::size_t first_output = 0; ///< query whose results go to the first place of the arrays below; `value`, `gradient` likewise
  float* weight = nullptr;      ///< sum of w
  float* height = nullptr;      ///< sum of w f_i
  MutableVectors<float> normal; ///< sum of w n
  MutableVectors<float> slope;  ///< sum of s u with s = t^3 v / h_i^2; grad w = -8 s u
  MutableVectors<float> tilt;   ///< sum of s f_i u
  float close = 0;              ///< plain fit only, and what follows: u^2 / h_i^2 below which a datum counts as close
  float* count = nullptr;       ///< data that reach the query
  float* close_count = nullptr; ///< those that are close
  float* inverse_sq = nullptr;  ///< sum of w / h_i^2
};

/** Moments of the data in reach relative to the query: count, sum of d, sum of d d^T, each datum as often as its weight says. */
struct Moments {
  Vectors<float> queries, data;
  Radius<float> radius;
  const float* data_weight = nullptr; ///< null: all 1
  std::size_t first_output = 0; ///< query whose results go to the first place of the arrays below
  float* count = nullptr;
  MutableVectors<float> mean;             ///< sum of d
  MutableVectors<float> scatter_diagonal; ///< xx yy zz
  MutableVectors<float> scatter_mixed;    ///< yz xz xy
};

/** Moments of the data d = datum - query with d^T A d < 1, A the query's own metric; weight (1 - d^T A d)^2. */
struct SteeredMoments {
  Vectors<float> queries, query_normals, data, data_normals;
  Radius<float> radius;                   ///< of a ball about the query that holds the ellipsoid
  Vectors<float> metric_diagonal, metric_mixed; ///< A of each query: xx yy zz, yz xz xy
  Vectors<float> residuals;               ///< a vector of each datum, padded like the data
  float symmetry_falloff = 0;             ///< 1 / (1 - cos angle) of the share s that the datum's own plane gets, at most one half
  const float* data_weight = nullptr;     ///< null: all 1
  std::size_t first_output = 0;           ///< query whose results go to the first place of the arrays below
  float* weight_sum = nullptr;
  MutableVectors<float> mean;             ///< sum of weight * d
  MutableVectors<float> shift;            ///< sum of weight * ((1 - s) d + s (d.n) n + residual)
  MutableVectors<float> scatter_diagonal; ///< sum of weight * d d^T: xx yy zz
  MutableVectors<float> scatter_mixed;    ///< yz xz xy
};

/** Sums of two fields over the data in reach; a datum weighs as much as its normal agrees with the query's, in shape
 * exp(-((1 - |cos|) normal_falloff)^2). */
struct FieldSums {
  Vectors<float> queries, query_normals, data, data_normals;
  Radius<float> radius;
  float normal_falloff = 0;            ///< 1 / (1 - cos angle); 0: all weights are 1 and normals are not read
  const float* first_field = nullptr;
  const float* second_field = nullptr;
  float* count = nullptr;              ///< number of data in reach
  float* weight_sum = nullptr;
  float* first_sum = nullptr;          ///< sum of weight * first_field
  float* second_sum = nullptr;
};

/** Sums of the planes of the data in reach, seen along two directions m of each query: weight = exp(-falloff r^2 / radius^2 - ((1 - m.n)
 * angle_falloff)^2), offset = sum of weight * (query - datum).n, normal = sum of weight * n. */
struct SideSums {
  Vectors<float> queries, directions[2], data, data_normals;
  Radius<float> radius;
  float falloff = 0;
  float angle_falloff = 0;    ///< 1 / (1 - cos sigma_n)
  bool sign_invariant = true; ///< normals are turned towards the direction
  const float* data_numbers = nullptr; ///< 32 bits that name a datum, whatever they are
  std::size_t first_output = 0;        ///< query whose results go to the first place of the arrays below
  float* weight[2] = {};
  float* offset[2] = {};
  MutableVectors<float> normal[2];
  float* nearest[2] = {};     ///< the number of the datum of largest weight; 0 when there is none
};

/** The gaps of greatest priority beside each of the points [first, last), which lie near each other. Runs hold their candidates. */
struct WidestGaps {
  Vectors<float> points, normals;
  const std::uint32_t* numbers = nullptr; ///< of the points; each pair is looked at by one end, which the numbers decide
  const Run* runs = nullptr;
  std::size_t run_count = 0, first = 0, last = 0;
  FloatBox box;                           ///< of the points [first, last)
  const float* radius_sq = nullptr;       ///< of each of them, within which neighbours are sought
  float largest_radius_sq = 0;
  bool sign_invariant = true;
  float parallel = 0, steep_sq = 0;       ///< pairs with |cos| above the first and a squared slope above the second are no gap
  float opposite = 0;                     ///< pairs with signs and a cos below this are no gap
  const float* edge_factors = nullptr;    ///< as edgeFactor() takes them
  float largest_factor = 1;               ///< 1: all factors are 1
  GapScratch* scratch = nullptr;          ///< with room for all candidates
  Gap* gaps = nullptr;                    ///< kGapsOfPoint of first, of first + 1 ...
};

/** For each of the gaps [first, last) those among the runs that are better, of greater priority or equal priority and before it, and
 * whose base lies within its clearance. Arrays of gaps have room for a vector behind them. */
struct BetterGaps {
  Vectors<float> bases;
  const float* clearance_sq = nullptr;
  const float* priority = nullptr;
  const Run* runs = nullptr;
  std::size_t run_count = 0, first = 0, last = 0;
  std::uint32_t* better = nullptr;  ///< with room for all pairs and a vector more
  std::uint32_t* row_end = nullptr; ///< of each gap, counted from `better`
};

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
