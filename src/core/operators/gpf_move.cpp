// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_kernels.h"
#include "gpf_solver.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

/** \file
 * \brief The pull of the data (first sum of eq. 10), the move of the samples, and the residuals of eq. 11.
 */
namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;

template <typename Real>
Real
angleFalloff(double degrees)
{
  return static_cast<Real>(1.0 / (1.0 - std::cos(degrees * kPi / 180.0)));
}

} // namespace

/** Sums of the data term for the samples of one task; still in the cache when these are moved. */
template <typename Real>
struct GPFSolver<Real>::DataSums {
  explicit DataSums(std::size_t size, bool variance)
  : weight(size + kQueryBlock), pull(size)
  {
    if (!variance)
      return;
    posterior = AlignedArray<Real>(size + kQueryBlock);
    residual_sq = AlignedArray<Real>(size + kQueryBlock);
    cross = SortedVectors<Real>(size);
    diagonal = SortedVectors<Real>(size);
    mixed = SortedVectors<Real>(size);
  }

  void
  receive(kernels::Projection<Real>& a)
  {
    a.weight_sum = weight.data();
    a.pull = pull.vectors();
    a.posterior_sum = posterior.data();
    a.residual_sq = residual_sq.data();
    a.cross = cross.vectors();
    a.scatter_diagonal = diagonal.vectors();
    a.scatter_mixed = mixed.vectors();
  }

  /** Sum of posterior ((d - delta).b)^2 after the move delta (eq. 11). */
  double
  residualAfter(std::size_t m, double x, double y, double z) const
  {
    const double linear = x * cross.x[m] + y * cross.y[m] + z * cross.z[m];
    const double quadratic = x * x * diagonal.x[m] + y * y * diagonal.y[m] + z * z * diagonal.z[m] +
                             2.0 * (y * z * mixed.x[m] + x * z * mixed.y[m] + x * y * mixed.z[m]);
    return std::max(0.0, residual_sq[m] - 2.0 * linear + quadratic);
  }

  AlignedArray<Real> weight;
  SortedVectors<Real> pull;
  AlignedArray<Real> posterior, residual_sq;
  SortedVectors<Real> cross, diagonal, mixed;
};

template <typename Real>
kernels::Projection<Real>
GPFSolver<Real>::dataTerm() const
{
  kernels::Projection<Real> a;
  a.queries = cloud_.samples().vectors();
  a.query_normals = cloud_.sampleNormals().vectors();
  a.data = cloud_.points();
  a.data_normals = cloud_.pointNormals();
  a.radius.radius_sq = static_cast<Real>(data_radius_ * data_radius_);
  a.falloff = static_cast<Real>(data_radius_ * data_radius_ / (2.0 * variance_));
  a.symmetric = parameters.data_term == DataTerm::Symmetric;
  a.symmetry_falloff = angleFalloff<Real>(30.0);
  a.normal_weights = parameters.normal_angle < 90.0 && parameters.normal_weight_floor < 1.0;
  a.normal_falloff = angleFalloff<Real>(parameters.normal_angle);
  a.normal_floor = static_cast<Real>(parameters.normal_weight_floor);
  a.data_weight = point_weight_.empty() ? nullptr : point_weight_.data();
  a.data_density = inverse_density_.empty() ? nullptr : inverse_density_.data();
  if constexpr (std::is_same<Real, float>::value)
    if (!merged_.empty()) {
      a.data = merged_.positions.vectors();
      a.data_normals = merged_.normals.vectors();
      a.data_weight = merged_.weights.data();
    }
  a.variance = parameters.variance_update != VarianceUpdate::Fixed;
  return a;
}

/** Whether a sample's data are nothing but the input point that seeded it; `weight` is the sum of its data weights. */
template <typename Real>
bool
GPFSolver<Real>::isIsolated(std::size_t m, double weight) const
{
  constexpr double kRounding = 1e-4; // of the short exponential and of sums in float
  if (point_weight_.empty() && weight > 1.0 + kRounding) // the seed alone weighs no more than 1
    return false;
  const std::size_t seed = cloud_.seedOf(m);
  const kernels::Vectors<Real> from = cloud_.points();
  const SortedVectors<Real>& samples = cloud_.samples();
  const double x = samples.x[m] - from.x[seed], y = samples.y[m] - from.y[seed], z = samples.z[m] - from.z[seed];
  const double distance_sq = x * x + y * y + z * z;
  if (!(distance_sq < data_radius_ * data_radius_))
    return !(weight > 0.0);
  double own = std::exp(-distance_sq / (2.0 * variance_)); // the seed's normal is the sample's: full weight
  if (!point_weight_.empty())
    own *= static_cast<double>(point_weight_[seed]) * static_cast<double>(inverse_density_[seed]);
  return !(weight > own * (1.0 + kRounding));
}

/** Eq. 10 for one sample: the mean pull of the data, and the mean push of the other samples times mu. */
template <typename Real>
typename GPFSolver<Real>::Step
GPFSolver<Real>::stepOf(std::size_t m, const DataSums& data, std::size_t place, const RepulsionSums& repulsion,
                        double mu) const
{
  Step step;
  if (data.weight[place] > Real(0)) {
    step.x = data.pull.x[place] / data.weight[place];
    step.y = data.pull.y[place] / data.weight[place];
    step.z = data.pull.z[place] / data.weight[place];
  }
  if (!(mu > 0.0) || !(repulsion.weight[m] > Real(0)))
    return step;
  const Real scale = static_cast<Real>(mu) / repulsion.weight[m];
  Real x = scale * repulsion.push.x[m], y = scale * repulsion.push.y[m], z = scale * repulsion.push.z[m];
  if (parameters.own_tangent_repulsion) {
    const SortedVectors<Real>& n = cloud_.sampleNormals();
    const Real height = x * n.x[m] + y * n.y[m] + z * n.z[m];
    x -= height * n.x[m];
    y -= height * n.y[m];
    z -= height * n.z[m];
  }
  step.x += x;
  step.y += y;
  step.z += z;
  return step;
}

/** Moves the samples [begin, end), whose sums are in `data`. */
template <typename Real>
void
GPFSolver<Real>::moveBlock(std::size_t begin, std::size_t end, const DataSums& data, const RepulsionSums& repulsion,
                           MoveSums& sum)
{
  SortedVectors<Real>& samples = cloud_.samples();
  const double mu = repulsion.weight.empty() ? 0.0 : repulsionWeight();
  const bool variance = !data.posterior.empty();
  for (std::size_t m = begin; m < end; ++m) {
    const std::size_t place = m - begin;
    const Step step = stepOf(m, data, place, repulsion, mu);
    isolated_[m] = isIsolated(m, static_cast<double>(data.weight[place]));
    sum.isolated += isolated_[m];
    sum.posterior += variance ? data.posterior[place] : data.weight[place];
    if (variance)
      sum.residual += data.residualAfter(place, step.x, step.y, step.z);
    samples.x[m] += step.x;
    samples.y[m] += step.y;
    samples.z[m] += step.z;
    const double x = step.x, y = step.y, z = step.z;
    const double length = std::sqrt(x * x + y * y + z * z);
    sum.movement += length;
    sum.longest = std::max(sum.longest, length);
  }
}

/** Sums over the data and moves the samples, block by block: their data stand still, and the push of other samples is
 * known. */
template <typename Real>
IterationStats
GPFSolver<Real>::move(const RepulsionSums& repulsion)
{
  const kernels::Candidates candidates = candidatesOf(current(data_neighborhoods_, false, true));
  const kernels::Projection<Real> term = dataTerm();
  const std::size_t blocks = blockCount(size());
  std::vector<MoveSums> partials((blocks + kBlocksPerTask - 1) / kBlocksPerTask);
  parallelBlocks(blocks, kBlocksPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    DataSums data(kBlocksPerTask * kQueryBlock, term.variance);
    kernels::Projection<Real> a = term;
    a.first_output = begin * kQueryBlock;
    data.receive(a);
    projectionKernel<Real>()(candidates, a, begin, end);
    moveBlock(a.first_output, std::min(size(), end * kQueryBlock), data, repulsion, partials[begin / kBlocksPerTask]);
  });
  MoveSums total;
  for (const MoveSums& partial : partials)
    total.add(partial);
  return finishIteration(total);
}

template IterationStats GPFSolver<float>::move(const RepulsionSums&);
template IterationStats GPFSolver<double>::move(const RepulsionSums&);

} // namespace pcl_gpf
