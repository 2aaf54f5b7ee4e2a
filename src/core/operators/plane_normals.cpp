// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/plane_normals.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "../merged_points.h"
#include "../sorted_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace pcl_gpf {

namespace {

constexpr std::size_t kFewestNeighbors = 6;
/** Neighbourhoods for points whose ball holds too few neighbours, or only those of one scan line: the first that spans a plane. */
constexpr std::array<std::size_t, 3> kNearestInstead = {12, 32, 96};
/** Second eigenvalue below this share of the largest: the points lie on a line or coincide, no plane is better than another. Moments
 * summed in float and the closed-form eigenvalues resolve about 1e-7. */
constexpr double kLineRatio = 1e-6;
/** Below this share the plane turns freely about the line that the points follow. */
constexpr double kNarrowRatio = 0.05;

struct MomentSums {
  explicit MomentSums(std::size_t size) : count(size + kQueryBlock), mean(size), diagonal(size), mixed(size) {}

  AlignedArray<float> count;
  SortedVectors<float> mean, diagonal, mixed;
};

struct PlaneFit {
  Eigen::Vector3d normal{0.0, 0.0, 1.0};
  double surface_variation = 0.0;
  bool spans_plane = false;
  bool narrow = true;
};

PlaneFit
fitPlane(double count, const Eigen::Vector3d& sum, Eigen::Matrix3d scatter)
{
  PlaneFit fit;
  if (count < 3.0)
    return fit;
  const Eigen::Vector3d mean = sum / count;
  scatter = scatter / count - mean * mean.transpose();
  const double size = scatter.trace();
  if (!(size > 0.0))
    return fit;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter / size);
  const Eigen::Vector3d values = solver.eigenvalues();
  if (!(values[1] > kLineRatio * values[2]))
    return fit;
  fit.spans_plane = true;
  fit.narrow = values[1] < kNarrowRatio * values[2];
  fit.normal = solver.eigenvectors().col(0).normalized();
  Eigen::Index largest = 0;
  fit.normal.cwiseAbs().maxCoeff(&largest);
  if (fit.normal[largest] < 0.0)
    fit.normal = -fit.normal;
  fit.surface_variation = std::max(0.0, values[0]);
  return fit;
}

PlaneFit
fitNearest(const ClusterTree& tree, PointsView points, std::size_t i, std::vector<float>& distances_sq,
           std::vector<std::uint32_t>& indices)
{
  PlaneFit fit;
  for (const std::size_t count : kNearestInstead) {
    tree.nearest(points, {points.x[i], points.y[i], points.z[i]}, count, distances_sq, &indices);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const std::uint32_t j : indices) {
      const Eigen::Vector3d d(points.x[j] - points.x[i], points.y[j] - points.y[i], points.z[j] - points.z[i]);
      sum += d;
      scatter += d * d.transpose();
    }
    fit = fitPlane(static_cast<double>(indices.size()), sum, scatter);
    if (!fit.narrow || indices.size() < count)
      break;
  }
  return fit;
}

PlaneFit
fitMoments(const MomentSums& m, std::size_t i)
{
  Eigen::Matrix3d scatter;
  scatter << m.diagonal.x[i], m.mixed.z[i], m.mixed.y[i], //
      m.mixed.z[i], m.diagonal.y[i], m.mixed.x[i],        //
      m.mixed.y[i], m.mixed.x[i], m.diagonal.z[i];
  return fitPlane(m.count[i], Eigen::Vector3d(m.mean.x[i], m.mean.y[i], m.mean.z[i]), scatter);
}

kernels::Moments
momentsInto(MomentSums& sums, PointsView points, const MergedPoints& merged, double radius)
{
  kernels::Moments a;
  a.queries = a.data = {points.x, points.y, points.z};
  if (!merged.empty()) {
    a.data = merged.positions.vectors();
    a.data_weight = merged.weights.data();
  }
  a.radius.radius_sq = static_cast<float>(radius * radius);
  a.count = sums.count.data();
  a.mean = sums.mean.vectors();
  a.scatter_diagonal = sums.diagonal.vectors();
  a.scatter_mixed = sums.mixed.vectors();
  return a;
}

} // namespace

void
validate(const PlaneNormalsParameters& parameters)
{
  checkRange("normal radius", parameters.radius, parameters.radius >= 0.0, ">= 0, 0 = estimated");
}

std::size_t
estimatePlaneNormals(const PlaneNormalsParameters& parameters, PointsView points, MutableVectorsView normals,
                     float* surface_variation)
{
  const PointIndex index(points, parameters.number_of_threads);
  SoaBuffer sorted(index.size());
  AlignedArray<float> variation(surface_variation ? index.size() : 0);
  const std::size_t failed =
      estimatePlaneNormals(parameters, index, sorted.view(), surface_variation ? variation.data() : nullptr);
  for (std::size_t k = 0; k < index.size(); ++k) {
    normals.x[index.order()[k]] = sorted.x[k];
    normals.y[index.order()[k]] = sorted.y[k];
    normals.z[index.order()[k]] = sorted.z[k];
    if (surface_variation)
      surface_variation[index.order()[k]] = variation[k];
  }
  return failed;
}

std::size_t
estimatePlaneNormals(const PlaneNormalsParameters& parameters, const PointIndex& points, MutableVectorsView normals,
                     float* surface_variation)
{
  checkRange("normal radius", parameters.radius, parameters.radius > 0.0, "> 0");
  refuseExcessiveWork(estimateWork(parameters, points));
  const std::size_t threads = resolveThreads(parameters.number_of_threads);
  const PointsView view = points.sorted();
  const double radius = boundedRadius(parameters.radius);
  const MergedPoints merged = mergePoints(points, {}, {radius}, parameters.merge_above, false, threads);
  const Neighborhoods near = findNeighborhoods(merged.empty() ? points.tree() : merged.tree, view, radius, threads);
  const kernels::Candidates candidates = candidatesOf(near);
  const std::size_t blocks = blockCount(view.size);
  std::vector<std::size_t> failures((blocks + kBlocksPerTask - 1) / kBlocksPerTask);
  parallelBlocks(blocks, kBlocksPerTask, threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin * kQueryBlock, last = std::min(view.size, end * kQueryBlock);
    MomentSums sums(kBlocksPerTask * kQueryBlock); // of this task alone, so that it is still in the cache when planes are fitted
    kernels::Moments a = momentsInto(sums, view, merged, radius);
    a.first_output = first;
    kernels::active().moments(candidates, a, begin, end);
    std::vector<float> distances_sq;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = first; i < last; ++i) {
      PlaneFit fit;
      if (sums.count[i - first] >= static_cast<float>(kFewestNeighbors))
        fit = fitMoments(sums, i - first);
      if (fit.narrow)
        fit = fitNearest(points.tree(), view, i, distances_sq, indices);
      failures[begin / kBlocksPerTask] += !fit.spans_plane;
      normals.x[i] = static_cast<float>(fit.normal[0]);
      normals.y[i] = static_cast<float>(fit.normal[1]);
      normals.z[i] = static_cast<float>(fit.normal[2]);
      if (surface_variation)
        surface_variation[i] = static_cast<float>(fit.surface_variation);
    }
  });
  return std::accumulate(failures.begin(), failures.end(), std::size_t{0});
}

} // namespace pcl_gpf
