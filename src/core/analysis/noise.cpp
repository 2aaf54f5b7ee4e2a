// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Dense>

namespace pcl_gpf {

namespace {

constexpr std::size_t kMostProbes = 512;
/** Sizes of neighbourhood, each twice the one before. */
constexpr std::array<std::size_t, 5> kScales = {48, 96, 192, 384, 768};
constexpr std::size_t kQuadricTerms = 6;
/** A neighbourhood is a patch of surface, rather than a blob of noise, when it is at least this many times wider than thick. */
constexpr double kFlatness = 2.5;

/** Residual standard deviation of a quadric height field over the plane of `count` nearest points; and width over thickness. */
struct PatchFit {
  double residual = 0.0;
  double flatness = 0.0;
};

PatchFit
fitPatch(PointsView points, const std::vector<std::uint32_t>& indices, std::size_t count)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> p(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    p.col(static_cast<Eigen::Index>(i)) << points.x[indices[i]], points.y[indices[i]], points.z[indices[i]];
  p.colwise() -= p.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> frame((p * p.transpose() / static_cast<double>(count)).eval());
  const double width = std::sqrt(std::max(0.0, frame.eigenvalues()[1]));
  if (!(width > 0.0))
    return {};
  p = (frame.eigenvectors().transpose() * p / width).eval(); // heights in row 0, the plane in rows 1 and 2
  Eigen::Matrix<double, Eigen::Dynamic, kQuadricTerms> terms(static_cast<Eigen::Index>(count), kQuadricTerms);
  terms.col(0).setOnes();
  terms.col(1) = p.row(1).transpose();
  terms.col(2) = p.row(2).transpose();
  terms.col(3) = terms.col(1).cwiseProduct(terms.col(1));
  terms.col(4) = terms.col(1).cwiseProduct(terms.col(2));
  terms.col(5) = terms.col(2).cwiseProduct(terms.col(2));
  const Eigen::Matrix<double, kQuadricTerms, kQuadricTerms> normal_matrix = terms.transpose() * terms;
  const Eigen::VectorXd heights = p.row(0).transpose();
  const Eigen::Matrix<double, kQuadricTerms, 1> solution = normal_matrix.ldlt().solve(terms.transpose() * heights);
  const double sum_sq = (heights - terms * solution).squaredNorm();
  PatchFit fit;
  fit.residual = width * std::sqrt(sum_sq / static_cast<double>(count - kQuadricTerms));
  fit.flatness = fit.residual > 0.0 ? width / fit.residual : kFlatness + 1.0;
  return fit;
}

/** Below the median, since neighbourhoods across edges only ever show too much noise; the spread of the good ones costs 3 to 8 %. */
double
lowerQuantile(std::vector<double>& values)
{
  constexpr double kQuantile = 0.35;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(values.size()) * kQuantile);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

} // namespace

double
estimateNoise(PointsView points, double spacing, unsigned number_of_threads)
{
  return estimateNoise(PointIndex(points, number_of_threads), spacing, number_of_threads);
}

double
estimateNoise(const PointIndex& points, double spacing, unsigned number_of_threads)
{
  if (points.size() < kScales.front() || !(spacing > 0.0))
    return 0.0;
  const PointsView view = points.sorted();
  const std::size_t probes = std::min(kMostProbes, points.size());
  std::vector<double> estimates(probes);
  parallelBlocks(probes, 16, resolveThreads(number_of_threads), [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    std::vector<std::uint32_t> indices;
    for (std::size_t probe = begin; probe < end; ++probe) {
      const std::size_t i = probe * points.size() / probes;
      // The smallest neighbourhood that is clearly a patch: larger ones see edges and curvature, smaller ones only noise.
      for (const std::size_t count : kScales) {
        if (count > points.size())
          break;
        points.tree().nearest(view, {view.x[i], view.y[i], view.z[i]}, count, distances_sq, &indices);
        const PatchFit fit = fitPatch(view, indices, count);
        estimates[probe] = fit.residual;
        if (fit.flatness >= kFlatness)
          break;
      }
    }
  });
  return lowerQuantile(estimates);
}

} // namespace pcl_gpf
