// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_solver.h"

#include "gpf_kernels.h"

#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

/** \file
 * \brief Algorithm 1: what an iteration does in which order, and the lists of candidates.
 */
namespace pcl_gpf {

namespace {

/** Keeps eq. 3 finite when every residual is 0; far below any variance that weights could tell apart. */
constexpr double kLeastVariance = 1e-60;

} // namespace

template <typename Real>
GPFSolver<Real>::GPFSolver(const GPFParameters& p, const GPFInput& input)
: search_(input.search)
, cloud_(input, p.number_of_threads)
, threads_(resolveThreads(p.number_of_threads))
, data_radius_(0.5 * p.support_radius)
, data_neighborhoods_(0.5 * p.support_radius, 1.0)
, posterior_neighborhoods_(0.5 * p.support_radius, 1.0)
, repulsion_neighborhoods_(p.support_radius, 2.0)
, variance_(p.initial_variance > 0.0 ? p.initial_variance : 0.25 * p.support_radius * p.support_radius)
{
  parameters = p;
  refuseExcessiveWork(estimateWork(p, cloud_.index(), size(), static_cast<bool>(search_)));
  isolated_.assign(size(), 0);
  evaluateDensities();
}

template <typename Real>
void
GPFSolver<Real>::mergeData()
{
  if constexpr (std::is_same<Real, float>::value) {
    const kernels::Vectors<float> n = cloud_.pointNormals();
    if (!search_ && point_weight_.empty()) // merged points have no weights of their own
      merged_ = mergePoints(cloud_.index(), {n.x, n.y, n.z, cloud_.pointCount()}, {data_radius_},
                            parameters.merge_above, false, threads_);
  }
}

template <typename Real>
IterationStats
GPFSolver<Real>::step()
{
  const auto start = std::chrono::steady_clock::now();
  if (iteration_ == 0) // not before: by now the caller may have freed its arrays
    mergeData();
  if (parameters.posterior_normalization)
    evaluatePosteriorDenominators();                                // E-step, eq. 3
  const RepulsionSums repulsion = evaluateRepulsion();              // M-step, eq. 10, second sum
  IterationStats stats = move(repulsion);                           // eq. 10, first sum, and eq. 11
  ++iteration_;
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

/** Statistics, the next sigma^2 (eq. 11), and how far the candidate lists have aged. */
template <typename Real>
IterationStats
GPFSolver<Real>::finishIteration(const MoveSums& total)
{
  IterationStats stats;
  stats.mean_movement = total.movement / static_cast<double>(std::max<std::size_t>(1, size()));
  stats.max_movement = total.longest;
  stats.posterior_sum = total.posterior;
  stats.isolated_points = total.isolated;
  stats.variance = variance_;
  if (parameters.variance_update != VarianceUpdate::Fixed && total.posterior > 0.0) {
    const double degrees_of_freedom = parameters.variance_update == VarianceUpdate::Paper ? 3.0 : 1.0;
    variance_ = std::max(kLeastVariance, total.residual / (degrees_of_freedom * total.posterior));
  }
  stats.next_variance = variance_;
  for (MovingNeighborhoods* lists : {&data_neighborhoods_, &posterior_neighborhoods_, &repulsion_neighborhoods_})
    lists->addMovement(stats.max_movement);
  return stats;
}

template <typename Real>
Neighborhoods
GPFSolver<Real>::neighborhoods(const ClusterTree& tree, PointsView data, PointsView queries, double reach) const
{
  if (search_)
    return transposeLists(search_(data, queries, reach), queries.size, data.size);
  return findNeighborhoods(tree, queries, reach, threads_);
}

template <typename Real>
const Neighborhoods&
GPFSolver<Real>::current(MovingNeighborhoods& moving, bool data_are_samples, bool queries_are_samples)
{
  if (moving.stale()) {
    const PointsView samples = cloud_.samples().floatView(float_samples_), sorted = cloud_.index().sorted();
    if (data_are_samples)
      sample_tree_.fit(samples, threads_);
    const ClusterTree& data_tree = merged_.empty() ? cloud_.index().tree() : merged_.tree;
    moving.set(neighborhoods(data_are_samples ? sample_tree_ : data_tree, data_are_samples ? samples : sorted,
                             queries_are_samples ? samples : sorted, moving.reach()));
  }
  return moving.get();
}

template <typename Real>
void
GPFSolver<Real>::releaseNeighborhoods()
{
  for (MovingNeighborhoods* lists : {&data_neighborhoods_, &posterior_neighborhoods_, &repulsion_neighborhoods_})
    lists->release();
}

template <typename Real>
std::vector<std::uint8_t>
GPFSolver<Real>::isolated() const
{
  std::vector<std::uint8_t> out(size());
  parallelBlocks(size(), kGPFPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      out[cloud_.rankOf(s)] = isolated_[s];
  });
  return out;
}

template class GPFSolver<float>;
template class GPFSolver<double>;

} // namespace pcl_gpf
