// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernel_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

/** \file
 * \brief Every kernel as a case: how to run it, and what a pair contributes to its sums, written out in double.
 */
namespace pcl_gpf::test {

/** \brief A contribution of one pair to one sum. `scale` bounds what rounding is relative to. */
struct Term {
  double value;
  double scale;
};

/** \brief One pair in double: d = datum - query. */
struct Pair {
  std::array<double, 3> d, query_normal, normal, datum;
  double r_sq, radius_sq, weight, density, query_radius_sq;

  static double
  dot(const std::array<double, 3>& a, const std::array<double, 3>& b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  double height() const { return dot(d, normal); }
  double cosine() const { return dot(normal, query_normal); }
};

template <typename Real>
Pair
pairOf(const KernelInput<Real>& in, std::size_t q, std::size_t j, double radius_sq)
{
  Pair pair;
  pair.d = {static_cast<double>(in.data.x[j]) - in.queries.x[q], static_cast<double>(in.data.y[j]) - in.queries.y[q],
            static_cast<double>(in.data.z[j]) - in.queries.z[q]};
  pair.datum = {in.data.x[j], in.data.y[j], in.data.z[j]};
  pair.query_normal = {in.query_normals.x[q], in.query_normals.y[q], in.query_normals.z[q]};
  pair.normal = {in.data_normals.x[j], in.data_normals.y[j], in.data_normals.z[j]};
  pair.r_sq = Pair::dot(pair.d, pair.d);
  pair.radius_sq = radius_sq;
  pair.weight = in.weight[j];
  pair.density = in.density[j];
  pair.query_radius_sq = in.radius_sq[q];
  return pair;
}

/** (1 - u^2 / 4)^4 for u < 2, else 0. */
inline double
bell(double u)
{
  return u < 2 ? std::pow(1 - u * u / 4, 4) : 0;
}

constexpr double kRadiusSq = 0.16;

/** \brief What all cases share. */
template <typename Real>
struct KernelCase {
  bool radius_per_query = false;
  double exp_error = 0.0; ///< relative, where it is more than rounding

  kernels::Radius<Real>
  radius(const KernelInput<Real>& in) const
  {
    return {static_cast<Real>(kRadiusSq), radius_per_query ? in.radius_sq.data() : nullptr};
  }
  double
  radiusSq(const KernelInput<Real>& in, std::size_t q, std::size_t) const
  {
    return radius_per_query ? static_cast<double>(in.radius_sq[q]) : static_cast<double>(static_cast<Real>(kRadiusSq));
  }
};

template <typename Real>
struct GaussianCase : KernelCase<Real> {
  double falloff = 4;

  std::string name() const { return "gaussian sums"; }
  std::size_t channels() const { return 1; }
  void
  run(const kernels::KernelSet& set, const KernelInput<Real>& in, KernelOutput<Real>& out) const
  {
    kernels::GaussianSums<Real> a;
    a.queries = in.queries.vectors();
    a.data = in.data.vectors();
    a.radius = this->radius(in);
    a.falloff = static_cast<Real>(falloff);
    a.out = out.channel(0);
    if constexpr (std::is_same<Real, float>::value)
      set.gaussian_sums_float(candidatesOf(in.near), a, 0, blockCount(in.query_count));
    else
      set.gaussian_sums_double(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const double gaussian = std::exp(-falloff * p.r_sq / p.radius_sq);
    return {{gaussian, gaussian}};
  }
};

template <typename Real>
struct ProjectionCase : KernelCase<Real> {
  bool symmetric = false, normal_weights = false, weighted = false, variance = false, density = weighted;
  double falloff = 3, symmetry_falloff = 7.5, normal_falloff = 3.4, normal_floor = 0.15;

  std::string
  name() const
  {
    return std::string("projection") + (symmetric ? " symmetric" : "") + (normal_weights ? " normals" : "") +
           (weighted ? " weighted" : "") + (density ? " densities" : "") + (variance ? " variance" : "");
  }
  std::size_t channels() const { return variance ? 15 : 4; }
  void
  run(const kernels::KernelSet& set, const KernelInput<Real>& in, KernelOutput<Real>& out) const
  {
    kernels::Projection<Real> a;
    a.queries = in.queries.vectors();
    a.query_normals = in.query_normals.vectors();
    a.data = in.data.vectors();
    a.data_normals = in.data_normals.vectors();
    a.radius = this->radius(in);
    a.falloff = static_cast<Real>(falloff);
    a.symmetric = symmetric;
    a.symmetry_falloff = static_cast<Real>(symmetry_falloff);
    a.normal_weights = normal_weights;
    a.normal_falloff = static_cast<Real>(normal_falloff);
    a.normal_floor = static_cast<Real>(normal_floor);
    a.data_weight = weighted ? in.weight.data() : nullptr;
    a.data_density = density ? in.density.data() : nullptr;
    a.weight_sum = out.channel(0);
    a.pull = out.vectors(1);
    a.variance = variance;
    if (variance) {
      a.posterior_sum = out.channel(4);
      a.residual_sq = out.channel(5);
      a.cross = out.vectors(6);
      a.scatter_diagonal = out.vectors(9);
      a.scatter_mixed = out.vectors(12);
    }
    if constexpr (std::is_same<Real, float>::value)
      set.projection_float(candidatesOf(in.near), a, 0, blockCount(in.query_count));
    else
      set.projection_double(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const double reach = std::sqrt(p.r_sq);
    const double posterior = std::exp(-falloff * p.r_sq / p.radius_sq) * (weighted ? p.weight : 1.0);
    const double deviation = 1 - std::abs(p.cosine());
    const double by_normal = normal_weights ? normal_floor + (1 - normal_floor) * bell(deviation * normal_falloff) : 1.0;
    const double weight = posterior * (density ? p.density : 1.0) * by_normal;
    const double share = symmetric ? 0.5 * bell(deviation * symmetry_falloff) : 0.0;
    std::vector<Term> sums = {{weight, weight}};
    for (std::size_t i = 0; i < 3; ++i) {
      const double own = share * Pair::dot(p.d, p.query_normal) * p.query_normal[i];
      sums.push_back({weight * ((1 - share) * p.height() * p.normal[i] + own), weight * reach});
    }
    if (!variance)
      return sums;
    sums.push_back({posterior, posterior});
    sums.push_back({posterior * p.height() * p.height(), posterior * p.r_sq});
    for (std::size_t i = 0; i < 3; ++i)
      sums.push_back({posterior * p.height() * p.normal[i], posterior * reach});
    const auto& n = p.normal;
    for (const double product : {n[0] * n[0], n[1] * n[1], n[2] * n[2], n[1] * n[2], n[0] * n[2], n[0] * n[1]})
      sums.push_back({posterior * product, posterior});
    return sums;
  }
};

template <typename Real>
struct RepulsionCase : KernelCase<Real> {
  bool weighted = false;
  double falloff = 4, shortest = 1e-3;

  std::string name() const { return std::string("repulsion") + (weighted ? " weighted" : ""); }
  std::size_t channels() const { return 4; }
  void
  run(const kernels::KernelSet& set, const KernelInput<Real>& in, KernelOutput<Real>& out) const
  {
    kernels::Repulsion<Real> a;
    a.queries = in.queries.vectors();
    a.data = in.data.vectors();
    a.data_normals = in.data_normals.vectors();
    a.radius = this->radius(in);
    a.falloff = static_cast<Real>(falloff);
    a.shortest = static_cast<Real>(shortest);
    a.data_weight = weighted ? in.weight.data() : nullptr;
    a.weight_sum = out.channel(0);
    a.push = out.vectors(1);
    if constexpr (std::is_same<Real, float>::value)
      set.repulsion_float(candidatesOf(in.near), a, 0, blockCount(in.query_count));
    else
      set.repulsion_double(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    std::array<double, 3> t;
    for (std::size_t i = 0; i < 3; ++i)
      t[i] = -p.d[i] + p.height() * p.normal[i];
    const double r_sq = Pair::dot(t, t);
    if (r_sq == 0)
      return {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
    const double r = std::max(std::sqrt(r_sq), shortest);
    const double beta = std::exp(-falloff * r_sq / p.radius_sq) / r * (weighted ? p.weight : 1.0);
    const double cancellation = std::sqrt(p.r_sq) / r; // t is a difference of longer vectors
    std::vector<Term> sums = {{beta, beta * cancellation}};
    for (const double component : t)
      sums.push_back({beta * component, beta * r * cancellation});
    return sums;
  }
};

struct BilateralCase : KernelCase<float> {
  bool sign_invariant = true, weighted = false;
  double falloff = 1, angle_falloff = 7.5;

  std::string name() const { return std::string("bilateral normals") + (sign_invariant ? " sign-invariant" : " oriented") + (weighted ? " weighted" : ""); }
  std::size_t channels() const { return 3; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    kernels::BilateralNormals a;
    a.queries = in.queries.vectors();
    a.query_normals = in.query_normals.vectors();
    a.data = in.data.vectors();
    a.data_normals = in.data_normals.vectors();
    a.radius = radius(in);
    a.falloff = static_cast<float>(falloff);
    a.angle_falloff = static_cast<float>(angle_falloff);
    a.sign_invariant = sign_invariant;
    a.data_weight = weighted ? in.weight.data() : nullptr;
    a.out = out.vectors(0);
    set.bilateral_normals(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const double cosine = p.cosine();
    const double deviation = (1 - (sign_invariant ? std::abs(cosine) : cosine)) * angle_falloff;
    const double weight = std::exp(-falloff * p.r_sq / p.radius_sq) * std::exp(-deviation * deviation) * (weighted ? p.weight : 1.0);
    const double sign = sign_invariant && cosine < 0 ? -1 : 1;
    const double rounding = 1 + 2 * deviation * angle_falloff; // of the exponent
    std::vector<Term> sums;
    for (const double component : p.normal)
      sums.push_back({sign * weight * component, weight * rounding});
    return sums;
  }
};

struct MomentsCase : KernelCase<float> {
  bool weighted = false;

  std::string name() const { return std::string("moments") + (weighted ? " weighted" : ""); }
  std::size_t channels() const { return 10; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    kernels::Moments a;
    a.queries = in.queries.vectors();
    a.data = in.data.vectors();
    a.radius = radius(in);
    a.data_weight = weighted ? in.weight.data() : nullptr;
    a.count = out.channel(0);
    a.mean = out.vectors(1);
    a.scatter_diagonal = out.vectors(4);
    a.scatter_mixed = out.vectors(7);
    set.moments(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const auto& d = p.d;
    const double weight = weighted ? p.weight : 1.0;
    std::vector<Term> sums = {{weight, weight}};
    for (const double component : d)
      sums.push_back({weight * component, weight * std::abs(component)});
    for (const double product : {d[0] * d[0], d[1] * d[1], d[2] * d[2], d[1] * d[2], d[0] * d[2], d[0] * d[1]})
      sums.push_back({weight * product, weight * std::abs(product)});
    return sums;
  }
};

struct FieldCase : KernelCase<float> {
  bool normals = false, along = false;

  std::string name() const { return std::string("field sums") + (normals ? " normals" : "") + (along ? " along them" : ""); }
  std::size_t channels() const { return 4; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    kernels::FieldSums a;
    a.queries = in.queries.vectors();
    a.query_normals = in.query_normals.vectors();
    a.data = in.data.vectors();
    a.data_normals = in.data_normals.vectors();
    a.radius = radius(in);
    a.normal_falloff = normals ? kFalloff : 0.0f;
    a.along_normals = along;
    a.first_field = in.weight.data();
    a.second_field = in.density.data();
    a.count = out.channel(0);
    a.weight_sum = out.channel(1);
    a.first_sum = out.channel(2);
    a.second_sum = out.channel(3);
    set.field_sums(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const double weight = normals ? bell((1 - std::abs(p.cosine())) * kFalloff) : 1.0;
    const double scale = normals ? 8.0 : 1.0; // the fourth power and the cancellation in 1 - |cos| multiply rounding
    const double turned = along && p.cosine() < 0 ? -p.weight : p.weight;
    return {{1, 1}, {weight, scale}, {weight * turned, scale * std::abs(p.weight)}, {weight * p.density, scale * std::abs(p.density)}};
  }

private:
  static constexpr float kFalloff = 7.5f;
};

/** A metric for each query, made of its normal: flat across, round along. */
struct SteeredCase : KernelCase<float> {
  bool weighted = false;

  std::string name() const { return std::string("steered moments") + (weighted ? " weighted" : ""); }
  std::size_t channels() const { return 13; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    SortedVectors<float> diagonal(in.query_count), mixed(in.query_count);
    for (std::size_t q = 0; q < in.query_count; ++q) {
      const float x = in.query_normals.x[q], y = in.query_normals.y[q], z = in.query_normals.z[q];
      diagonal.x[q] = kRound + kAcross * x * x, diagonal.y[q] = kRound + kAcross * y * y, diagonal.z[q] = kRound + kAcross * z * z;
      mixed.x[q] = kAcross * y * z, mixed.y[q] = kAcross * x * z, mixed.z[q] = kAcross * x * y;
    }
    kernels::SteeredMoments a;
    a.queries = in.queries.vectors();
    a.data = in.data.vectors();
    a.radius = radius(in);
    a.metric_diagonal = diagonal.vectors();
    a.metric_mixed = mixed.vectors();
    a.residuals = in.data.vectors();
    a.data_weight = weighted ? in.weight.data() : nullptr;
    a.weight_sum = out.channel(0);
    a.mean = out.vectors(1);
    a.query_normals = in.query_normals.vectors();
    a.data_normals = in.data_normals.vectors();
    a.symmetry_falloff = kFalloff;
    a.shift = out.vectors(4);
    a.scatter_diagonal = out.vectors(7);
    a.scatter_mixed = out.vectors(10);
    set.steered_moments(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const auto& d = p.d;
    const double across = Pair::dot(d, p.query_normal);
    const double share = std::max(0.0, 1 - kRound * p.r_sq - kAcross * across * across);
    const double weight = share * share * (weighted ? p.weight : 1.0);
    const double scale = 16.0; // of the form, whose terms cancel
    std::vector<Term> sums = {{weight, scale}};
    for (const double component : d)
      sums.push_back({weight * component, scale * std::abs(component)});
    const double planes = 0.5 * bell((1 - std::abs(p.cosine())) * kFalloff);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double height = (1 - planes) * d[axis] + planes * p.height() * p.normal[axis];
      sums.push_back({weight * (height + p.datum[axis]), scale * (std::abs(height) + std::abs(p.datum[axis]) + 1)});
    }
    for (const double product : {d[0] * d[0], d[1] * d[1], d[2] * d[2], d[1] * d[2], d[0] * d[2], d[0] * d[1]})
      sums.push_back({weight * product, scale * std::abs(product)});
    return sums;
  }

private:
  static constexpr float kRound = 7.0f, kAcross = 30.0f, kFalloff = 7.5f;
};

/** Any three vectors serve as axes: the query's normal and its components in other orders. Any positions serve as raised ones: the data's
 * normals. */
struct QuadricCase : KernelCase<float> {
  std::string name() const { return "quadric moments"; }
  std::size_t channels() const { return kernels::QuadricMoments::kSums; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    kernels::QuadricMoments a;
    a.radius = radius(in);
    a.one_by_radius = 1.0f / std::sqrt(a.radius.radius_sq);
    a.queries = in.queries.vectors();
    const kernels::Vectors<float> n = in.query_normals.vectors();
    a.axis_n = n;
    a.axis_u = {n.y, n.z, n.x};
    a.axis_v = {n.z, n.x, n.y};
    a.data = in.data.vectors();
    a.noisy = a.data_normals = in.data_normals.vectors();
    a.data_weight = a.spread = in.weight.data();
    a.within = in.density.data();
    a.row = blockCount(in.query_count) * kQueryBlock;
    AlignedArray<float> sums(channels() * a.row);
    a.sums = sums.data();
    set.quadric_moments(candidatesOf(in.near), a, 0, blockCount(in.query_count));
    for (std::size_t c = 0; c < channels(); ++c)
      std::copy_n(sums.data() + c * a.row, in.query_count, out.channel(c));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    constexpr double kScale = 64.0; // powers, and 1 - r^2 squared, multiply rounding
    const auto& n = p.query_normal;
    const std::array<double, 3> u = {n[1], n[2], n[0]}, v = {n[2], n[0], n[1]};
    std::array<double, 3> raised;
    for (std::size_t axis = 0; axis < 3; ++axis)
      raised[axis] = p.normal[axis] - (p.datum[axis] - p.d[axis]);
    const double r = std::sqrt(p.radius_sq), x = Pair::dot(p.d, u) / r, y = Pair::dot(p.d, v) / r, h = Pair::dot(raised, n) / r;
    const double bell = std::pow(1 - p.r_sq / p.radius_sq, 2), w = bell * p.weight, most = kScale * (1 + std::abs(h)) / r;
    std::vector<Term> sums;
    const auto add = [&](double value, double scale) { sums.push_back({value, kScale * scale}); };
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j)
        add(w * std::pow(x, i) * std::pow(y, j), p.weight);
    for (const double power : {1.0, x, y, x * x, x * y, y * y})
      add(w * h * power, p.weight * most);
    add(w * h * h, p.weight * most * most);
    const double side = p.cosine() < 0 ? -1 : 1, along_u = side * Pair::dot(p.normal, u), along_v = side * Pair::dot(p.normal, v);
    for (const double slope : {along_u, along_v})
      for (const double power : {1.0, x, y})
        add(w * slope * power, p.weight);
    add(w * (along_u * along_u + along_v * along_v), p.weight);
    add(w * std::abs(p.cosine()), p.weight);
    add(bell, 1);
    add(bell * p.density, p.density);
    add(w * p.weight, p.weight * p.weight);
    return sums;
  }
};

/** The sums of a RIMLS fit; the radius is the datum's. */
struct ImplicitCase {
  bool robust = false;
  double exp_error = 0.0;
  double normal_falloff = 1.7, residual_falloff = 4.0, close = 0.25;

  std::string name() const { return robust ? "implicit sums, robust" : "implicit sums, plain"; }
  std::size_t channels() const { return robust ? 11 : 14; }
  double radiusSq(const KernelInput<float>& in, std::size_t, std::size_t j) const { return 1.0 / inverseSq(in)[j]; }
  void
  run(const kernels::KernelSet& set, const KernelInput<float>& in, KernelOutput<float>& out) const
  {
    const AlignedArray<float> inverse_sq = inverseSq(in);
    kernels::ImplicitSums a;
    a.queries = in.queries.vectors();
    a.data = in.data.vectors();
    a.data_normals = in.data_normals.vectors();
    a.radius.inverse_sq_per_datum = inverse_sq.data();
    a.robust = robust;
    a.value = in.radius_sq.data(); // any numbers of the queries do
    a.gradient = in.query_normals.vectors();
    a.normal_falloff = static_cast<float>(normal_falloff);
    a.residual_falloff = static_cast<float>(residual_falloff);
    a.weight = out.channel(0);
    a.height = out.channel(1);
    a.normal = out.vectors(2);
    a.slope = out.vectors(5);
    a.tilt = out.vectors(8);
    if (!robust) {
      a.close = static_cast<float>(close);
      a.count = out.channel(11);
      a.close_count = out.channel(12);
      a.inverse_sq = out.channel(13);
    }
    set.implicit_sums(candidatesOf(in.near), a, 0, blockCount(in.query_count));
  }
  std::vector<Term>
  terms(const Pair& p) const
  {
    const double ratio = p.r_sq / p.radius_sq, t = 1 - ratio, height = -p.height();
    // Rounding of the ratio is relative to 1, not to what is left of it; the exponent's is relative to its size.
    double v = 1, slack = 1;
    if (robust) {
      double turn = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        turn += std::pow(p.normal[axis] - p.query_normal[axis], 2);
      const double exponent = normal_falloff * turn + residual_falloff * std::pow(height - p.query_radius_sq, 2) / p.radius_sq;
      v = std::exp(-exponent);
      slack = 1 + exponent;
    }
    const double w = std::pow(t, 4) * v, s = std::pow(t, 3) * v / p.radius_sq;
    const double r = std::sqrt(p.r_sq), w_scale = slack * std::pow(t, 3) * v, s_scale = slack * t * t * v / p.radius_sq;
    std::vector<Term> sums = {{w, w_scale}, {w * height, w_scale * r}};
    for (const double component : p.normal)
      sums.push_back({w * component, w_scale});
    for (const double component : p.d)
      sums.push_back({-s * component, s_scale * r});
    for (const double component : p.d)
      sums.push_back({-s * component * height, s_scale * p.r_sq});
    if (!robust) {
      sums.push_back({1, 1});
      sums.push_back({ratio < close ? 1.0 : 0.0, 1});
      sums.push_back({w / p.radius_sq, w_scale / p.radius_sq});
    }
    return sums;
  }

private:
  static AlignedArray<float>
  inverseSq(const KernelInput<float>& in)
  {
    AlignedArray<float> inverse_sq(in.weight.size());
    for (std::size_t j = 0; j < inverse_sq.size(); ++j)
      inverse_sq[j] = 4.0f / in.weight[j];
    return inverse_sq;
  }
};

/** \brief Calls visit(case) for every kernel in every combination of its switches. */
template <typename Real, typename Visit>
void
forEveryCase(const Visit& visit)
{
  for (const bool per_query : {false, true}) {
    visit(GaussianCase<Real>{{per_query}});
    for (unsigned bits = 0; bits < 12; ++bits)
      visit(ProjectionCase<Real>{{per_query}, (bits & 1) != 0, (bits & 2) != 0, bits >= 4, bits >= 8});
    // Falloffs up to one half take the short exponential in float.
    for (const bool weighted : {false, true})
      for (const double falloff : {0.5, 1.0})
        visit(ProjectionCase<Real>{{per_query, 8e-7}, weighted || falloff < 1, true, weighted, false, false, falloff});
    for (const bool weighted : {false, true})
      visit(RepulsionCase<Real>{{per_query}, weighted});
    if constexpr (std::is_same<Real, float>::value) {
      for (const bool weighted : {false, true}) {
        for (const bool sign_invariant : {false, true})
          visit(BilateralCase{{per_query}, sign_invariant, weighted});
        visit(MomentsCase{{per_query}, weighted});
        visit(FieldCase{{per_query}, weighted});
        if (weighted)
          visit(FieldCase{{per_query}, true, true});
        visit(SteeredCase{{per_query}, weighted});
      }
      if (!per_query)
        visit(QuadricCase{});
      visit(ImplicitCase{per_query}); // plain and robust
    }
  }
}

} // namespace pcl_gpf::test
