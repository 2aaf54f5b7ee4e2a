// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_solver.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <type_traits>

namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;
/** Keeps eq. 3 finite when every residual is 0; far below any variance that weights could tell apart. */
constexpr double kLeastVariance = 1e-60;
constexpr unsigned kIterationsWithoutRepulsion = 3;
constexpr std::size_t kPointsPerTask = 8192;
/** Shortest distance, as a share of h, by which a repulsion is divided in the default mode. */
constexpr double kShortestRepulsion = 1e-3;

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
struct GPFSolver<Real>::RepulsionSums {
  AlignedArray<Real> weight;
  SortedVectors<Real> push;
};

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
  isolated_.assign(size(), 0);
  evaluateDensities();
  mergeData();
}

template <typename Real>
void
GPFSolver<Real>::mergeData()
{
  if constexpr (std::is_same<Real, float>::value) {
    const kernels::Vectors<float> n = cloud_.pointNormals();
    if (!search_ && point_weight_.empty()) // merged points have no weights of their own
      merged_ = mergePoints(cloud_.index(), {n.x, n.y, n.z, cloud_.pointCount()}, {data_radius_}, parameters.merge_above, false, threads_);
  }
}

/** rho_n = 1 + sum over n' != n of theta(|v_n - v_n'|), within h / 2; the point itself contributes the 1. */
template <typename Real>
void
GPFSolver<Real>::evaluateDensities()
{
  const bool weighted =
      parameters.density_weights || parameters.posterior_normalization || parameters.variance_update != VarianceUpdate::Fixed;
  if (!weighted)
    return;
  point_weight_ = AlignedArray<Real>(cloud_.pointCount() + kQueryBlock, Real(1));
  inverse_density_ = AlignedArray<Real>(cloud_.pointCount() + kQueryBlock, Real(1));
  if (!parameters.density_weights)
    return;
  const PointsView sorted = cloud_.index().sorted();
  gaussianSums(cloud_.points(), cloud_.pointCount(), cloud_.points(), neighborhoods(cloud_.index().tree(), sorted, sorted, data_radius_), data_radius_, 1.0,
               inverse_density_);
  parallelBlocks(cloud_.pointCount(), kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      inverse_density_[n] = Real(1) / std::max(Real(1), inverse_density_[n]);
  });
}

template <typename Real>
IterationStats
GPFSolver<Real>::step()
{
  const auto start = std::chrono::steady_clock::now();
  if (parameters.posterior_normalization)
    evaluatePosteriorDenominators();                                // E-step, eq. 3
  const RepulsionSums repulsion = evaluateRepulsion();              // M-step, eq. 10, second sum
  IterationStats stats = move(repulsion);                           // eq. 10, first sum, and eq. 11
  ++iteration_;
  stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return stats;
}

/** point_weight_ = 1 / (sum over m' of exp(-|v_n - x_m'|^2 / (2 sigma^2)) + c); 0 where nothing claims the point. */
template <typename Real>
void
GPFSolver<Real>::evaluatePosteriorDenominators()
{
  const double omega = parameters.outlier_weight;
  const double c = std::pow(2.0 * kPi * variance_, 1.5) * omega / (1.0 - omega) * static_cast<double>(cloud_.samples().size()) /
                   static_cast<double>(cloud_.pointCount());
  gaussianSums(cloud_.points(), cloud_.pointCount(), cloud_.samples().vectors(), current(posterior_neighborhoods_, true, false), data_radius_,
               data_radius_ * data_radius_ / (2.0 * variance_), point_weight_);
  parallelBlocks(cloud_.pointCount(), kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Real denominator = point_weight_[n] + static_cast<Real>(c);
      point_weight_[n] = denominator > Real(0) ? Real(1) / denominator : Real(0);
    }
  });
}

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
    gaussianSums(cloud_.samples().vectors(), size(), cloud_.samples().vectors(), near, h, 4.0, sample_density); // w_m; theta(r) = exp(-4 r^2 / h^2)
  }
  RepulsionSums sums{AlignedArray<Real>(cloud_.samples().size() + kQueryBlock), SortedVectors<Real>(cloud_.samples().size())};
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
GPFSolver<Real>::stepOf(std::size_t m, const DataSums& data, std::size_t place, const RepulsionSums& repulsion, double mu) const
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
GPFSolver<Real>::moveBlock(std::size_t begin, std::size_t end, const DataSums& data, const RepulsionSums& repulsion, MoveSums& sum)
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

/** Sums over the data and moves the samples, block by block: their data stand still, and the push of other samples is known. */
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
void
GPFSolver<Real>::gaussianSums(kernels::Vectors<Real> queries, std::size_t count, kernels::Vectors<Real> data,
                              const Neighborhoods& neighborhoods, double radius, double falloff, AlignedArray<Real>& out) const
{
  kernels::GaussianSums<Real> a;
  a.queries = queries;
  a.data = data;
  a.radius.radius_sq = static_cast<Real>(radius * radius);
  a.falloff = static_cast<Real>(falloff);
  a.out = out.data();
  const kernels::Candidates candidates = candidatesOf(neighborhoods);
  parallelBlocks(blockCount(count), kBlocksPerTask, threads_,
                 [&](std::size_t begin, std::size_t end) { gaussianKernel<Real>()(candidates, a, begin, end); });
}

template <typename Real>
Neighborhoods
GPFSolver<Real>::neighborhoods(const ClusterTree& tree, PointsView data, PointsView queries, double reach) const
{
  if (search_)
    return transposeLists(search_(data, queries, reach), data.size);
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
  parallelBlocks(size(), kPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      out[cloud_.rankOf(s)] = isolated_[s];
  });
  return out;
}

template class GPFSolver<float>;
template class GPFSolver<double>;

} // namespace pcl_gpf
