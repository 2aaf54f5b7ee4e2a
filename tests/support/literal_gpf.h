// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_gpf::test {

/** \brief The paper's recursion, term by term, in double and without any neighbour structure: the oracle of the paper
 * mode.
 *
 * Eqs. 3, 10 and 11 with the neighbourhoods of section 4.4. O(N M + M^2) a step; N of a few thousand is fine. Names are
 * the paper's.
 */
struct LiteralGPF {
  using Vector3 = std::array<double, 3>;

  std::vector<Vector3> v;   ///< V in the frame whose box diagonal is 1
  std::vector<Vector3> b;   ///< unit normals of V
  std::vector<Vector3> x;   ///< X, starts as a subset of V
  std::vector<Vector3> b_x; ///< normals of X: those of the seeds
  double h = 0;
  double omega = 0.02;
  double mu = 0.2;
  double variance = 0.004; ///< sigma^2
  bool density_weights = true;

  /** \brief Sum of all p_mn of the last step. */
  double n_p = 0;

  void
  step()
  {
    const std::vector<double> denominators = posteriorDenominators();
    const std::vector<double> rho = density_weights ? densities(v, h / 2) : std::vector<double>(v.size(), 1.0);
    const std::vector<double> w = density_weights ? densities(x, h) : std::vector<double>(x.size(), 1.0);
    const std::vector<Vector3> old = x;
    for (std::size_t m = 0; m < old.size(); ++m) {
      const Vector3 data = dataTerm(old[m], denominators, rho);
      const Vector3 repulsion = repulsionTerm(old, m, w);
      for (std::size_t i = 0; i < 3; ++i)
        x[m][i] = old[m][i] + data[i] + mu * repulsion[i];
    }
    updateVariance(old, denominators);
  }

private:
  static Vector3 minus(const Vector3& p, const Vector3& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
  static double dot(const Vector3& p, const Vector3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
  static double length(const Vector3& p) { return std::sqrt(dot(p, p)); }

  double gaussian(double r) const { return std::exp(-r * r / (2 * variance)); }
  double theta(double r) const { return std::exp(-r * r / ((h / 2) * (h / 2))); }

  /** Denominator of eq. 3 for every v_n. */
  std::vector<double>
  posteriorDenominators() const
  {
    constexpr double kPi = 3.14159265358979323846;
    const double uniform = std::pow(2 * kPi * variance, 1.5) * omega * static_cast<double>(x.size()) /
                           ((1 - omega) * static_cast<double>(v.size()));
    std::vector<double> sums(v.size(), uniform);
    for (std::size_t n = 0; n < v.size(); ++n)
      for (const Vector3& x_m : x)
        if (const double r = length(minus(v[n], x_m)); r <= h / 2)
          sums[n] += gaussian(r);
    return sums;
  }

  /** p_mn (eq. 3); 0 beyond h / 2 and where the denominator is 0. */
  double
  posterior(const Vector3& x_m, std::size_t n, const std::vector<double>& denominators) const
  {
    const double r = length(minus(v[n], x_m));
    return r <= h / 2 && denominators[n] > 0 ? gaussian(r) / denominators[n] : 0;
  }

  /** rho_n or w_m: 1 + sum of theta over the others within the radius. */
  std::vector<double>
  densities(const std::vector<Vector3>& points, double radius) const
  {
    std::vector<double> sums(points.size(), 1.0);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < points.size(); ++j)
        if (const double r = length(minus(points[i], points[j])); i != j && r <= radius)
          sums[i] += theta(r);
    return sums;
  }

  /** Second term of eq. 10. */
  Vector3
  dataTerm(const Vector3& x_m, const std::vector<double>& denominators, const std::vector<double>& rho) const
  {
    Vector3 sum{0, 0, 0};
    double weights = 0;
    for (std::size_t n = 0; n < v.size(); ++n) {
      const double weight = posterior(x_m, n, denominators) / rho[n];
      const double distance = dot(minus(v[n], x_m), b[n]);
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += weight * distance * b[n][i];
      weights += weight;
    }
    return quotient(sum, weights);
  }

  /** Third term of eq. 10 without mu. */
  Vector3
  repulsionTerm(const std::vector<Vector3>& old, std::size_t m, const std::vector<double>& w) const
  {
    Vector3 sum{0, 0, 0};
    double weights = 0;
    for (std::size_t k = 0; k < old.size(); ++k) {
      const Vector3 difference = minus(old[m], old[k]);
      if (k == m || length(difference) > h)
        continue;
      const double height = dot(difference, b_x[k]);
      const Vector3 tangential = {difference[0] - height * b_x[k][0],
                                  difference[1] - height * b_x[k][1],
                                  difference[2] - height * b_x[k][2]};
      const double r = length(tangential);
      if (r == 0)
        continue;
      const double weight = w[k] * theta(r) / r; // w_m' beta_mm', |d eta / d r| = 1
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += weight * tangential[i];
      weights += weight;
    }
    return quotient(sum, weights);
  }

  /** Eq. 11 with d = 3: old posteriors, new positions. */
  void
  updateVariance(const std::vector<Vector3>& old, const std::vector<double>& denominators)
  {
    double sum = 0;
    n_p = 0;
    for (std::size_t m = 0; m < old.size(); ++m)
      for (std::size_t n = 0; n < v.size(); ++n) {
        const double p = posterior(old[m], n, denominators);
        const double distance = dot(minus(v[n], x[m]), b[n]);
        sum += p * distance * distance;
        n_p += p;
      }
    if (n_p > 0)
      variance = sum / (3 * n_p);
  }

  static Vector3
  quotient(const Vector3& sum, double weights)
  {
    return weights > 0 ? Vector3{sum[0] / weights, sum[1] / weights, sum[2] / weights} : Vector3{0, 0, 0};
  }
};

} // namespace pcl_gpf::test
