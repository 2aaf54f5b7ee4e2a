// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernel_scene.h"

#include "core/kernels/kernels.h"

/** \file
 * \brief What each kernel is called with on the scene; output arrays live in the given Sums.
 */
namespace pcl_gpf::benchmark_arguments {

using namespace benchmark_scene;

constexpr std::size_t kIdealData = 256; ///< that the ideal loops run over: at most 16 KB
constexpr float kEverywhere = 4;        ///< squared radius that holds all of the normalised frame; no exponential underflows

template <typename Real>
kernels::Radius<Real>
radius()
{
  const double r = scene<Real>().radius;
  return {static_cast<Real>(r * r), nullptr};
}

template <typename Real>
kernels::GaussianSums<Real>
gaussianSums(Sums<Real>& out)
{
  kernels::GaussianSums<Real> a;
  a.queries = a.data = scene<Real>().points.vectors();
  a.radius = radius<Real>();
  a.falloff = 1;
  a.out = out.one();
  return a;
}

/** \param[in] paper Algorithm 1's term with the sums of eq. 11, else the default mode's */
template <typename Real>
kernels::Projection<Real>
projection(Sums<Real>& out, bool paper)
{
  const Scene<Real>& s = scene<Real>();
  kernels::Projection<Real> a;
  a.queries = a.data = s.points.vectors();
  a.query_normals = a.data_normals = s.normals.vectors();
  a.radius = radius<Real>();
  a.falloff = Real(0.5);
  a.symmetric = a.normal_weights = !paper;
  a.symmetry_falloff = Real(7.46);
  a.normal_falloff = Real(3.41);
  a.normal_floor = Real(0.15);
  a.weight_sum = out.one();
  a.pull = out.three();
  a.variance = paper;
  if (paper) {
    a.data_weight = a.data_density = s.ones.data();
    a.posterior_sum = out.one();
    a.residual_sq = out.one();
    a.cross = out.three();
    a.scatter_diagonal = out.three();
    a.scatter_mixed = out.three();
  }
  return a;
}

inline kernels::Projection<float>
defaultProjection(Sums<float>& out)
{
  return projection(out, false);
}

inline kernels::Projection<double>
paperProjection(Sums<double>& out)
{
  return projection(out, true);
}

template <typename Real>
kernels::Repulsion<Real>
repulsion(Sums<Real>& out)
{
  const Scene<Real>& s = scene<Real>();
  kernels::Repulsion<Real> a;
  a.queries = a.data = s.points.vectors();
  a.data_normals = s.normals.vectors();
  a.radius = radius<Real>();
  a.falloff = 4;
  a.shortest = Real(1e-6);
  a.push = out.three();
  a.weight_sum = out.one();
  return a;
}

inline kernels::BilateralNormals
bilateralNormals(Sums<float>& out)
{
  const Scene<float>& s = scene<float>();
  kernels::BilateralNormals a;
  a.queries = a.data = s.points.vectors();
  a.query_normals = a.data_normals = s.normals.vectors();
  a.radius = radius<float>();
  a.angle_falloff = 7.46f;
  a.out = out.three();
  return a;
}

inline kernels::Moments
moments(Sums<float>& out)
{
  kernels::Moments a;
  a.queries = a.data = scene<float>().points.vectors();
  a.radius = radius<float>();
  a.count = out.one();
  a.mean = out.three();
  a.scatter_diagonal = out.three();
  a.scatter_mixed = out.three();
  return a;
}

/** Two fields that are at hand stand for the heights and their like. */
inline kernels::FieldSums
fieldSums(Sums<float>& out)
{
  const Scene<float>& s = scene<float>();
  kernels::FieldSums a;
  a.queries = a.data = s.points.vectors();
  a.query_normals = a.data_normals = s.normals.vectors();
  a.radius = radius<float>();
  a.normal_falloff = 3.41f;
  a.first_field = s.ones.data();
  a.second_field = s.points.vectors().z;
  a.count = out.one();
  a.weight_sum = out.one();
  a.first_sum = out.one();
  a.second_sum = out.one();
  return a;
}

} // namespace pcl_gpf::benchmark_arguments
