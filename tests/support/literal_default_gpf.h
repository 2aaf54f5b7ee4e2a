// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/local_cloud.h"

#include <pcl_gpf/core/operators/gpf_parameters.h>

#include <cmath>
#include <vector>

namespace pcl_gpf::test {

/** \brief One step of the default mode (fixed sigma^2, no posteriors, no densities) written out in double over all pairs. */
struct LiteralDefaultGPF {
  GPFParameters p;
  const std::vector<Vector3>& v;
  const std::vector<Vector3>& b;
  const AlignedArray<float>* data_weights = nullptr; ///< of the data; null: 1

  /** \brief Displacement of the sample at x[m] with normal n[m]. `undecided` is set when rounding to float leaves open whether a
   * pair is within a radius. */
  Vector3
  displacement(const std::vector<Vector3>& x, const std::vector<Vector3>& n, std::size_t m, bool with_repulsion, bool& undecided) const
  {
    Vector3 move = dataTerm(x[m], n[m], undecided);
    if (with_repulsion) {
      const Vector3 push = repulsion(x, n, m, undecided);
      for (std::size_t i = 0; i < 3; ++i)
        move[i] += p.repulsion_weight * push[i];
    }
    return move;
  }

private:
  static double dot(const Vector3& a, const Vector3& c) { return a[0] * c[0] + a[1] * c[1] + a[2] * c[2]; }
  static Vector3 minus(const Vector3& a, const Vector3& c) { return {a[0] - c[0], a[1] - c[1], a[2] - c[2]}; }
  static double bell(double u) { return u < 2 ? std::pow(1 - u * u / 4, 4) : 0; }
  static double oneMinusCosine(double degrees) { return 1 - std::cos(degrees * 3.14159265358979323846 / 180); }

  static bool
  within(double r, double radius, bool& undecided)
  {
    undecided = undecided || std::abs(r / radius - 1) < 1e-5;
    return r < radius;
  }

  Vector3
  dataTerm(const Vector3& x, const Vector3& n, bool& undecided) const
  {
    const double h = p.support_radius;
    const double variance = p.initial_variance > 0 ? p.initial_variance : h * h / 4;
    Vector3 sum{0, 0, 0};
    double weights = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const Vector3 d = minus(v[k], x);
      const double r = std::sqrt(dot(d, d));
      if (!within(r, h / 2, undecided))
        continue;
      const double turn = 1 - std::abs(dot(b[k], n)); // 1 - cos of the angle between the planes
      const double floor = p.normal_weight_floor;
      const double weight =
          (data_weights ? static_cast<double>((*data_weights)[k]) : 1.0) * std::exp(-r * r / (2 * variance)) * (floor + (1 - floor) * bell(turn / oneMinusCosine(p.normal_angle)));
      const double share = p.data_term == DataTerm::Symmetric ? 0.5 * bell(turn / oneMinusCosine(30)) : 0;
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += weight * ((1 - share) * dot(d, b[k]) * b[k][i] + share * dot(d, n) * n[i]);
      weights += weight;
    }
    if (weights == 0)
      return {0, 0, 0};
    return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
  }

  Vector3
  repulsion(const std::vector<Vector3>& x, const std::vector<Vector3>& n, std::size_t m, bool& undecided) const
  {
    const double h = p.support_radius;
    Vector3 sum{0, 0, 0};
    double weights = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Vector3 d = minus(x[m], x[k]);
      if (k == m || !within(std::sqrt(dot(d, d)), h, undecided))
        continue;
      const double height = dot(d, n[k]);
      const Vector3 t = {d[0] - height * n[k][0], d[1] - height * n[k][1], d[2] - height * n[k][2]};
      const double r = std::sqrt(dot(t, t));
      if (r == 0)
        continue;
      const double beta = std::exp(-4 * r * r / (h * h)) / std::max(r, p.own_tangent_repulsion ? 1e-3 * h : 0.0);
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += beta * t[i];
      weights += beta;
    }
    if (weights == 0)
      return {0, 0, 0};
    const Vector3 push = {sum[0] / weights, sum[1] / weights, sum[2] / weights};
    const double along = p.own_tangent_repulsion ? dot(push, n[m]) : 0;
    return {push[0] - along * n[m][0], push[1] - along * n[m][1], push[2] - along * n[m][2]};
  }
};

} // namespace pcl_gpf::test
