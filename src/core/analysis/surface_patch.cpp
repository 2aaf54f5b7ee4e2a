// SPDX-License-Identifier: BSD-3-Clause
#include "surface_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace pcl_gpf {

namespace {

constexpr int kTerms = 6;
constexpr std::size_t kFewestPoints = kTerms + 3;
constexpr int kRounds = 2;
/** The first window is wider by this: the plane it is laid along is only roughly that of the surface. */
constexpr double kFirstWindow = 4.0 / 3.0;
/** Second eigenvalue below this share of the largest: a scan line, even one whose noise is wider than its steps. */
constexpr double kNarrowRatio = 0.15;

using Terms = Eigen::Matrix<double, kTerms, 1>;

Eigen::Map<const Eigen::Vector3d>
vector(const Offset& p)
{
  return Eigen::Map<const Eigen::Vector3d>(p.data());
}

/** Second-degree terms of the place of a point in its plane; the height is in row 0. */
Terms
termsAt(const Eigen::Vector3d& p)
{
  Terms terms;
  terms << 1.0, p[1], p[2], p[1] * p[1], p[1] * p[2], p[2] * p[2];
  return terms;
}

struct PrincipalFrame {
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes; ///< columns: normal, then the plane
  bool narrow;
};

/** Of the points within `radius`. \return axes of zeros when all of them coincide */
PrincipalFrame
principalFrame(const std::vector<Offset>& points, double radius)
{
  PrincipalFrame frame{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), true};
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double count = 0.0;
  const auto inside = [&](const Offset& p) { return vector(p).squaredNorm() <= radius * radius; };
  for (const Offset& p : points)
    if (inside(p)) {
      frame.mean += vector(p);
      ++count;
    }
  frame.mean /= std::max(count, 1.0);
  for (const Offset& p : points)
    if (inside(p))
      scatter.noalias() += (vector(p) - frame.mean) * (vector(p) - frame.mean).transpose();
  if (!(scatter.trace() > 0.0))
    return frame;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.compute(scatter / scatter.trace());
  frame.axes = solver.eigenvectors();
  frame.narrow = solver.eigenvalues()[1] < kNarrowRatio * solver.eigenvalues()[2];
  return frame;
}

/** Where along the normal most of the points are: `middle`, unless a layer elsewhere holds many more, as where two sheets are near
 * and the middle is between them. */
double
densestHeight(const std::vector<Eigen::Vector3d>& points, double middle, double noise)
{
  constexpr int kBins = 32, kLayer = 6; // bins of half a noise, layers of three
  constexpr double kMuchDenser = 1.15;  // less may be chance
  const double per_bin = 2.0 / noise;
  std::array<int, kBins> bins{};
  for (const Eigen::Vector3d& p : points) {
    const double place = (p[0] - middle) * per_bin + 0.5 * kBins;
    if (place >= 0.0 && place < kBins)
      ++bins[static_cast<std::size_t>(place)];
  }
  std::array<int, kBins - kLayer + 1> held{}; // by the layers, from the lowest
  for (std::size_t layer = 0; layer < held.size(); ++layer)
    held[layer] = std::accumulate(bins.begin() + layer, bins.begin() + layer + kLayer, 0);
  const auto densest = std::max_element(held.begin(), held.end());
  const auto about_middle = held.begin() + held.size() / 2;
  if (!(*densest > kMuchDenser * *about_middle))
    return middle;
  return middle + static_cast<double>(densest - about_middle) / per_bin;
}

/** Least squares over the points whose height is within `window` of the surface `from`. \return how many those are */
std::size_t
fitHeights(const std::vector<Eigen::Vector3d>& points, double window, Terms& surface)
{
  Eigen::Matrix<double, kTerms, kTerms> normal_matrix = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Terms right = Terms::Zero();
  std::size_t count = 0;
  for (const Eigen::Vector3d& p : points) {
    const Terms terms = termsAt(p);
    if (!(std::abs(p[0] - surface.dot(terms)) <= window))
      continue;
    normal_matrix.noalias() += terms * terms.transpose();
    right += p[0] * terms;
    ++count;
  }
  if (count >= kFewestPoints)
    surface = normal_matrix.ldlt().solve(right);
  return count;
}

} // namespace

SurfacePatch
fitSurfacePatch(const std::vector<Offset>& points, double radius, double noise, double height, std::vector<float>* heights)
{
  SurfacePatch patch;
  const double low_sq = std::isfinite(noise) ? (height * height - kPatchTrim * kPatchTrim) * noise * noise : 0.0;
  const double core = low_sq > 0.0 ? std::sqrt(std::max(radius * radius - low_sq, 0.0)) : std::numeric_limits<double>::infinity();
  const PrincipalFrame frame = principalFrame(points, core); // of a ball that is no higher than it needs to be
  if (frame.axes.isZero(0.0) || !(radius > 0.0))
    return patch;
  patch.narrow = frame.narrow;
  patch.deviation = std::numeric_limits<double>::infinity();
  const double trim = kPatchTrim * noise / radius;
  const double cut = height * noise / radius;
  const double lateral_sq = std::isfinite(noise) ? 1.0 - cut * cut : std::numeric_limits<double>::infinity();
  patch.reach = std::isfinite(noise) ? radius * std::sqrt(std::max(lateral_sq, 0.0)) : radius;
  std::vector<Eigen::Vector3d> inside; // in units of the radius: heights, then the place in the plane
  inside.reserve(points.size());
  for (const Offset& point : points) {
    const Eigen::Vector3d p = frame.axes.transpose() * vector(point) / radius;
    if (p[1] * p[1] + p[2] * p[2] <= lateral_sq)
      inside.push_back(p);
  }
  Terms surface = Terms::Zero();
  surface[0] = frame.axes.col(0).dot(frame.mean) / radius;
  if (std::isfinite(noise))
    surface[0] = densestHeight(inside, surface[0], noise / radius);
  for (int round = 0; round < kRounds; ++round)
    if (fitHeights(inside, round == 0 ? kFirstWindow * trim : trim, surface) < kFewestPoints)
      return patch;
  double sum_sq = 0.0, sum_4 = 0.0;
  const double tilt = 1.0 / std::sqrt(1.0 + surface[1] * surface[1] + surface[2] * surface[2]);
  for (const Eigen::Vector3d& p : inside) {
    const double above = p[0] - surface.dot(termsAt(p));
    if (heights && std::abs(above) <= cut)
      heights->push_back(static_cast<float>(above * tilt * radius / noise));
    if (!(std::abs(above) <= trim))
      continue;
    sum_sq += above * above;
    sum_4 += above * above * above * above;
    ++patch.count;
  }
  if (patch.count < kFewestPoints)
    return patch;
  patch.trimmed = static_cast<double>(inside.size() - patch.count) / static_cast<double>(inside.size());
  patch.kurtosis = sum_sq > 0.0 ? static_cast<double>(patch.count) * sum_4 / (sum_sq * sum_sq) : 0.0;
  patch.deviation = radius * tilt * std::sqrt(sum_sq / static_cast<double>(patch.count - kTerms));
  for (std::size_t axis = 0; axis < 3; ++axis)
    patch.foot[axis] = frame.axes(static_cast<Eigen::Index>(axis), 0) * surface[0] * radius;
  return patch;
}

} // namespace pcl_gpf
