// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/local_cloud.h"

#include <pcl_gpf/core/operators/rimls_parameters.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_gpf::test {

/** \brief RIMLS as MeshLab computes it, written out in double over all pairs: local radius 2 sqrt(d^2 / 16) from the 16 nearest points
 * (itself counted), weight (1 - (r / (scale radius))^2)^4, refits until |change of gradient|^2 < 1e-3, at most 3 in all; a projection
 * steps by -f grad f / |grad f| until |f| <= accuracy * spacing, at most 15 times. With sigma_r > 0 also the paper's residual weight. */
struct LiteralRimls {
  RimlsParameters p;
  const std::vector<Vector3>& v;
  const std::vector<Vector3>& n;
  std::vector<double> r; ///< local radii

  struct Value {
    double f = 0;
    Vector3 gradient{0, 0, 0};
    bool inside = false;
    bool undecided = false; ///< rounding to float leaves open how many fits are made, or whether the position is inside
  };

  LiteralRimls(const RimlsParameters& parameters, const std::vector<Vector3>& points, const std::vector<Vector3>& normals)
  : p(parameters), v(points), n(normals), r(points.size())
  {
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (p.radius > 0) {
        r[i] = p.radius / p.scale;
        continue;
      }
      std::vector<double> distances;
      for (const Vector3& q : v)
        distances.push_back(distance(v[i], q));
      std::sort(distances.begin(), distances.end());
      const std::size_t count = std::min<std::size_t>(16, distances.size());
      r[i] = 2 * std::sqrt(distances[count - 1] * distances[count - 1] / static_cast<double>(count));
    }
  }

  Value
  evaluate(const Vector3& x) const
  {
    Value value;
    std::size_t reach = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double d = distance(x, v[i]), h = p.scale * r[i];
      reach += d < h;
      value.inside = value.inside || d < p.domain * r[i];
      value.undecided = value.undecided || std::abs(d / h - 1) < 1e-5 || std::abs(d / (p.domain * r[i]) - 1) < 1e-5;
    }
    value.inside = value.inside && reach >= p.minimum_samples;
    if (!value.inside)
      return value;
    double before_f = 0;
    Vector3 before{0, 0, 0};
    for (unsigned fit = 0; fit < p.fits; ++fit) {
      fitOnce(x, fit > 0, before_f, before, value);
      const double change = std::pow(distance(value.gradient, before), 2);
      value.undecided = value.undecided || std::abs(change / 1e-3 - 1) < 0.02;
      if (!(change > 1e-3))
        break;
      before_f = value.f;
      before = value.gradient;
    }
    return value;
  }

  /** \brief Projects x. \return whether it converged */
  bool
  project(Vector3& x, Vector3& normal, double spacing) const
  {
    for (unsigned iteration = 0; iteration < p.maximum_iterations; ++iteration) {
      const Value at = evaluate(x);
      if (!at.inside)
        return false;
      const double length = distance(at.gradient, {0, 0, 0});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        normal[axis] = at.gradient[axis] / length;
        x[axis] -= at.f * normal[axis];
      }
      if (std::abs(at.f) <= p.accuracy * spacing)
        return true;
    }
    return false;
  }

private:
  void
  fitOnce(const Vector3& x, bool robust, double before_f, const Vector3& before, Value& value) const
  {
    double sum_w = 0, sum_wf = 0;
    Vector3 sum_gw{0, 0, 0}, sum_gwf{0, 0, 0}, sum_wn{0, 0, 0};
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double d = distance(x, v[i]), h = p.scale * r[i];
      if (d >= h)
        continue;
      const double t = 1 - d * d / (h * h);
      double f = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        f += (x[axis] - v[i][axis]) * n[i][axis];
      double factor = 1;
      if (robust) {
        factor = std::exp(-std::pow(distance(n[i], before) / p.sigma_n, 2));
        if (p.sigma_r > 0)
          factor *= std::exp(-std::pow((f - before_f) / (p.sigma_r * h), 2));
      }
      const double w = factor * std::pow(t, 4);
      sum_w += w;
      sum_wf += w * f;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double gw = factor * -8 * (x[axis] - v[i][axis]) / (h * h) * std::pow(t, 3);
        sum_gw[axis] += gw;
        sum_gwf[axis] += gw * f;
        sum_wn[axis] += w * n[i][axis];
      }
    }
    value.f = sum_wf / sum_w;
    for (std::size_t axis = 0; axis < 3; ++axis)
      value.gradient[axis] = (sum_gwf[axis] - value.f * sum_gw[axis] + sum_wn[axis]) / sum_w;
  }
};

} // namespace pcl_gpf::test
