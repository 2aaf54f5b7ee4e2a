// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/kernels/kernels.h"

#include <cstddef>
#include <cstdint>

/** \file
 * \brief The arithmetic of the kernels at this machine's limit: the same accumulators, compiled for the same instruction sets, over
 * data that stay in the first cache, without a test of the radius, a filter of candidates or a neighbour structure.
 */
namespace pcl_gpf::ideal {

/** Sums over the `data_count` data behind the first 16, for the first 16 queries, `passes` times; so no query meets itself. */
template <class Arguments>
using Loop = void (*)(const Arguments& arguments, std::size_t data_count, std::size_t passes);

/** The loops of one instruction set, under the names that the benchmark gives the kernels. */
struct LoopSet {
  Loop<kernels::Projection<float>> projection_default;
  Loop<kernels::BilateralNormals> bilateral_normals;
  Loop<kernels::Moments> moments;
  Loop<kernels::FieldSums> field_sums;
  Loop<kernels::GaussianSums<float>> gaussian_sums;
  Loop<kernels::Repulsion<float>> repulsion;
  Loop<kernels::Projection<double>> projection_paper_double;
  Loop<kernels::GaussianSums<double>> gaussian_sums_double;
  Loop<kernels::Repulsion<double>> repulsion_double;
};

/** \param[in] bit Highway's, as in kernels::KernelTarget \return null if this build lacks the instruction set */
const LoopSet*
loops(std::int64_t bit);

} // namespace pcl_gpf::ideal
