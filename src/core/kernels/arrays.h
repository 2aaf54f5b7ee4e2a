// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

} // namespace kernels
} // namespace pcl_gpf
