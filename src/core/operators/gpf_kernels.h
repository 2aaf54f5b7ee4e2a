// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../kernels/kernels.h"

#include <cstddef>
#include <type_traits>

/** \file
 * \brief What the parts of GPFSolver have in common: the kernels of a number type, and sizes.
 */
namespace pcl_gpf {

/** Points that one task of a loop over points takes. */
constexpr std::size_t kGPFPointsPerTask = 8192;

template <typename Real>
const auto&
projectionKernel()
{
  if constexpr (std::is_same<Real, float>::value)
    return kernels::active().projection_float;
  else
    return kernels::active().projection_double;
}

template <typename Real>
const auto&
repulsionKernel()
{
  if constexpr (std::is_same<Real, float>::value)
    return kernels::active().repulsion_float;
  else
    return kernels::active().repulsion_double;
}

template <typename Real>
const auto&
gaussianKernel()
{
  if constexpr (std::is_same<Real, float>::value)
    return kernels::active().gaussian_sums_float;
  else
    return kernels::active().gaussian_sums_double;
}

} // namespace pcl_gpf
