// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.h"
#include "gaps.h"

#include <cstddef>

namespace pcl_gpf {
namespace kernels {

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

/** Normal equations of a quadric that is fitted to heights over the plane of each query, weight = (1 - r^2)^2 data_weight; all lengths
 * in radii, x and y along axis_u and axis_v. */
struct QuadricMoments {
  enum : std::size_t {
    kMonomials = 0,     ///< weight x^i y^j: i = 0, j = 0 .. 4; i = 1, j = 0 .. 3; ...
    kHeights = 15,      ///< weight height * (1, x, y, x^2, x y, y^2)
    kSquare = 21,       ///< weight height^2
    kSlopes = 22,       ///< weight m.u * (1, x, y), then m.v; m the datum's normal on the side of axis_n
    kSlopeSquare = 28,  ///< weight ((m.u)^2 + (m.v)^2)
    kAgreement = 29,    ///< weight m.n
    kBell = 30,         ///< (1 - r^2)^2
    kWithin = 31,       ///< the same * within
    kSpread = 32,       ///< weight spread
    kSums = 33
  };
  Vectors<float> queries, axis_u, axis_v, axis_n; ///< axes: an orthonormal frame of each query
  Vectors<float> data, noisy, data_normals;       ///< where a datum lies, where its height is taken, its normal of free sign
  const float* data_weight = nullptr;
  const float* within = nullptr;
  const float* spread = nullptr;
  Radius<float> radius;         ///< one for all
  float one_by_radius = 0;
  std::size_t first_output = 0; ///< query whose results go to the first place of each row
  float* sums = nullptr;        ///< kSums rows
  std::size_t row = 0;          ///< length of a row
};

/** Sums of two fields over the data in reach; a datum weighs as much as its normal agrees with the query's, in shape
 * exp(-((1 - |cos|) normal_falloff)^2). */
struct FieldSums {
  Vectors<float> queries, query_normals, data, data_normals;
  Radius<float> radius;
  float normal_falloff = 0;            ///< 1 / (1 - cos angle); 0: all weights are 1 and normals are not read
  bool along_normals = false;          ///< first_field is measured along the data's normals: turned where the query's is opposite
  const float* first_field = nullptr;
  const float* second_field = nullptr;
  float* count = nullptr;              ///< number of data in reach
  float* weight_sum = nullptr;
  float* first_sum = nullptr;          ///< sum of weight * first_field
  float* second_sum = nullptr;
};

/** Sums of the planes of the data in reach, seen along two directions m of each query: weight = exp(-falloff r^2 / radius^2 - ((1 - m.n)
 * angle_falloff)^2), offset = sum of weight * (query - datum).n, normal = sum of weight * n. Candidates are runs. */
struct SideSums {
  Vectors<float> queries, directions[2], data, data_normals;
  float radius_sq = 0;
  float falloff = 0;
  float angle_falloff = 0;    ///< 1 / (1 - cos sigma_n)
  bool sign_invariant = true; ///< normals are turned towards the direction
  std::size_t first_output = 0; ///< query whose results go to the first place of the arrays below
  float* weight[2] = {};
  float* offset[2] = {};
  MutableVectors<float> normal[2];
  std::uint32_t* nearest[2] = {}; ///< the first datum of largest weight; 0 when there is none
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
  RivalScratch* scratch = nullptr;  ///< with room for all of the runs
  std::uint32_t* better = nullptr;  ///< with room for all pairs and a vector more
  std::uint32_t* row_end = nullptr; ///< of each gap, counted from `better`
};

} // namespace kernels
} // namespace pcl_gpf
