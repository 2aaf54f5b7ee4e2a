// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.h"

#include <cstddef>

namespace pcl_gpf {
namespace kernels {

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

} // namespace kernels
} // namespace pcl_gpf
