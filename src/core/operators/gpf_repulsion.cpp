// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_kernels.h"
#include "gpf_solver.h"

#include <pcl_gpf/core/parallel.h>

/** \file
 * \brief The push of other samples (second sum of eq. 10).
 */
namespace pcl_gpf {

namespace {

constexpr unsigned kIterationsWithoutRepulsion = 3;
/** Shortest distance, as a share of h, by which a repulsion is divided in the default mode. */
constexpr double kShortestRepulsion = 1e-3;

} // namespace

template <typename Real>
double
GPFSolver<Real>::repulsionWeight() const
{
  const bool last = parameters.own_tangent_repulsion && parameters.maximum_iterations > kIterationsWithoutRepulsion &&
                    iteration_ + kIterationsWithoutRepulsion >= parameters.maximum_iterations;
  return last ? 0.0 : parameters.repulsion_weight;
}

template <typename Real>
typename GPFSolver<Real>::RepulsionSums
GPFSolver<Real>::evaluateRepulsion()
{
  if (repulsionWeight() == 0.0)
    return {};
  const double h = parameters.support_radius;
  const Neighborhoods& near = current(repulsion_neighborhoods_, true, true);
  AlignedArray<Real> sample_density;
  if (parameters.density_weights) {
    sample_density = AlignedArray<Real>(cloud_.samples().size() + kQueryBlock);
    // w_m; theta(r) = exp(-4 r^2 / h^2)
    gaussianSums(cloud_.samples().vectors(), size(), cloud_.samples().vectors(), near, h, 4.0, sample_density);
  }
  RepulsionSums sums{AlignedArray<Real>(cloud_.samples().size() + kQueryBlock),
                     SortedVectors<Real>(cloud_.samples().size())};
  kernels::Repulsion<Real> a;
  a.queries = a.data = cloud_.samples().vectors();
  a.data_normals = cloud_.sampleNormals().vectors();
  a.radius.radius_sq = static_cast<Real>(h * h);
  a.falloff = Real(4);
  a.shortest = parameters.own_tangent_repulsion ? static_cast<Real>(kShortestRepulsion * h) : Real(0);
  a.data_weight = sample_density.empty() ? nullptr : sample_density.data();
  a.push = sums.push.vectors();
  a.weight_sum = sums.weight.data();
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(cloud_.samples().size()), kBlocksPerTask, threads_,
                 [&](std::size_t begin, std::size_t end) { repulsionKernel<Real>()(candidates, a, begin, end); });
  return sums;
}

template double GPFSolver<float>::repulsionWeight() const;
template double GPFSolver<double>::repulsionWeight() const;
template GPFSolver<float>::RepulsionSums GPFSolver<float>::evaluateRepulsion();
template GPFSolver<double>::RepulsionSums GPFSolver<double>::evaluateRepulsion();

} // namespace pcl_gpf
