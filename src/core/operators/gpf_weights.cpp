// SPDX-License-Identifier: BSD-3-Clause
#include "gpf_kernels.h"
#include "gpf_solver.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

/** \file
 * \brief Weights of the input points: density (eq. 10) and posterior denominators (E-step, eq. 3).
 */
namespace pcl_gpf {

namespace {

constexpr double kPi = 3.14159265358979323846;

} // namespace

/** rho_n = 1 + sum over n' != n of theta(|v_n - v_n'|), within h / 2; the point itself contributes the 1. */
template <typename Real>
void
GPFSolver<Real>::evaluateDensities()
{
  const bool weighted = parameters.density_weights || parameters.posterior_normalization ||
                        parameters.variance_update != VarianceUpdate::Fixed;
  if (!weighted)
    return;
  point_weight_ = AlignedArray<Real>(cloud_.pointCount() + kQueryBlock, Real(1));
  inverse_density_ = AlignedArray<Real>(cloud_.pointCount() + kQueryBlock, Real(1));
  if (!parameters.density_weights)
    return;
  const PointsView sorted = cloud_.index().sorted();
  gaussianSums(cloud_.points(), cloud_.pointCount(), cloud_.points(),
               neighborhoods(cloud_.index().tree(), sorted, sorted, data_radius_), data_radius_, 1.0, inverse_density_);
  parallelBlocks(cloud_.pointCount(), kGPFPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      inverse_density_[n] = Real(1) / std::max(Real(1), inverse_density_[n]);
  });
}

/** point_weight_ = 1 / (sum over m' of exp(-|v_n - x_m'|^2 / (2 sigma^2)) + c); 0 where nothing claims the point. */
template <typename Real>
void
GPFSolver<Real>::evaluatePosteriorDenominators()
{
  const double omega = parameters.outlier_weight;
  const double c = std::pow(2.0 * kPi * variance_, 1.5) * omega / (1.0 - omega) *
                   static_cast<double>(cloud_.samples().size()) / static_cast<double>(cloud_.pointCount());
  gaussianSums(cloud_.points(), cloud_.pointCount(), cloud_.samples().vectors(),
               current(posterior_neighborhoods_, true, false), data_radius_,
               data_radius_ * data_radius_ / (2.0 * variance_), point_weight_);
  parallelBlocks(cloud_.pointCount(), kGPFPointsPerTask, threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Real denominator = point_weight_[n] + static_cast<Real>(c);
      point_weight_[n] = denominator > Real(0) ? Real(1) / denominator : Real(0);
    }
  });
}

template <typename Real>
void
GPFSolver<Real>::gaussianSums(kernels::Vectors<Real> queries, std::size_t count, kernels::Vectors<Real> data,
                              const Neighborhoods& neighborhoods, double radius, double falloff,
                              AlignedArray<Real>& out) const
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

template void GPFSolver<float>::evaluateDensities();
template void GPFSolver<double>::evaluateDensities();
template void GPFSolver<float>::evaluatePosteriorDenominators();
template void GPFSolver<double>::evaluatePosteriorDenominators();
template void
GPFSolver<float>::gaussianSums(kernels::Vectors<float>, std::size_t, kernels::Vectors<float>, const Neighborhoods&,
                               double, double, AlignedArray<float>&) const;
template void
GPFSolver<double>::gaussianSums(kernels::Vectors<double>, std::size_t, kernels::Vectors<double>, const Neighborhoods&,
                                double, double, AlignedArray<double>&) const;

} // namespace pcl_gpf
