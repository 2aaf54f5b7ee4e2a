// SPDX-License-Identifier: BSD-3-Clause
#include "fitted_quadric.h"

#include "../kernels/kernels.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace pcl_gpf {

namespace {

using Moments = kernels::QuadricMoments;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** Fewest means, by weight, that a quadric is fitted to. */
constexpr double kFewestMeans = 8.0;
/** Degrees of freedom, by weight, that six coefficients take in a full ball of weights (1 - r^2)^2. */
constexpr double kTaken = 2.4;
/** Least mean cosine of the normals with the query's: below, they are of other faces, or the query's is wrong. */
constexpr double kLeastAgreement = 0.7;
/** Normals may deviate from an even change by what filtered normals do on a plane, and by a share of that change, squared. */
constexpr double kEvenAngle = 3.0 * 3.14159265358979323846 / 180.0, kEvenShare = 0.15;
/** Least pivot of the normal equations in the largest: below, the data lie on a curve. */
constexpr double kLeastPivot = 1e-7;

/** Place of weight x^i y^j. */
constexpr std::size_t
monomial(std::size_t i, std::size_t j)
{
  return Moments::kMonomials + 5 * i - i * (i - 1) / 2 + j;
}

double
unevennessOf(const Matrix6& a, const Eigen::Matrix<double, 3, 2>& slopes, double square)
{
  const double weight = a(0, 0);
  const Eigen::Matrix<double, 3, 2> even = a.topLeftCorner<3, 3>().ldlt().solve(slopes);
  const double explained = (even.transpose() * slopes).trace() / weight;
  const double rest = std::max(0.0, square / weight - explained);
  const double change = std::max(0.0, explained - slopes.row(0).squaredNorm() / (weight * weight));
  return std::sqrt(rest / (kEvenAngle * kEvenAngle + kEvenShare * change));
}

} // namespace

double
FittedQuadric::height(double x, double y) const
{
  // (t.S t) (t.S^2 t), exact on spheres and cylinders, by its mean over directions; less the part that the fit took for a paraboloid.
  const double a = of[3], b = 0.5 * of[4], c = of[5], trace = a + c;
  const double trace_2 = a * a + 2 * b * b + c * c, trace_3 = a * a * a + c * c * c + 3 * b * b * trace;
  const double square = x * x + y * y;
  const double fourth = (trace * trace_2 + 2 * trace_3) / 8 * (square * square - 2.0 / 3.0 * square + 1.0 / 15.0);
  return of[0] + of[1] * x + of[2] * y + a * x * x + of[4] * x * y + c * y * y + fourth;
}

bool
solveQuadric(const float* sums, std::size_t row, double least_variance, FittedQuadric& quadric)
{
  static constexpr std::size_t kPowers[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  const auto sum = [&](std::size_t place) { return static_cast<double>(sums[place * row]); };
  const double means = sum(Moments::kBell), weight = sum(monomial(0, 0));
  if (!(means >= kFewestMeans) || !(sum(Moments::kAgreement) >= kLeastAgreement * weight))
    return false;
  Matrix6 a;
  Vector6 heights;
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c)
      a(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          sum(monomial(kPowers[r][0] + kPowers[c][0], kPowers[r][1] + kPowers[c][1]));
    heights[static_cast<Eigen::Index>(r)] = sum(Moments::kHeights + r);
  }
  const Eigen::LDLT<Matrix6> solver(a);
  if (!(solver.vectorD().minCoeff() > kLeastPivot * solver.vectorD().maxCoeff()))
    return false;
  Vector6& q = quadric.of;
  q = solver.solve(heights);
  const double freedom = weight - means; // of the points about their means
  const double variance = std::max(least_variance, freedom > 0.0 ? sum(Moments::kWithin) / freedom : 0.0);
  quadric.misfit = std::max(0.0, sum(Moments::kSquare) - q.dot(heights)) / (variance * std::max(1.0, means - kTaken));
  Eigen::Matrix<double, 3, 2> slopes;
  for (std::size_t k = 0; k < 6; ++k)
    slopes(static_cast<Eigen::Index>(k % 3), static_cast<Eigen::Index>(k / 3)) = sum(Moments::kSlopes + k);
  quadric.bending = std::abs(q[3] + q[5]) + std::hypot(q[3] - q[5], q[4]);
  quadric.unevenness = unevennessOf(a, slopes, sum(Moments::kSlopeSquare));
  // Means of points on a curved surface lie inside it; noise that moves points sideways lifts them outside.
  q[0] += (q[3] + q[5]) * (variance - sum(Moments::kSpread) / weight);
  return std::isfinite(quadric.misfit) && q.allFinite();
}

} // namespace pcl_gpf
