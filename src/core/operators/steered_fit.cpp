// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/steered_fit.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>

#include "../check_range.h"
#include "../merged_points.h"
#include "../sorted_points.h"
#include "steered_ellipsoids.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace pcl_gpf {

namespace {

/** Fewest points, by weight, that a plane is fitted to. */
constexpr float kFewestData = 4.0f;
/** Second eigenvalue below this share of the largest: a line, no plane is better than another. */
constexpr double kLineRatio = 1e-4;

/** Normals that deviate by more belong to other faces: their planes say nothing about a point's height. */
constexpr double kSymmetryAngle = 45.0 * 3.14159265358979323846 / 180.0;

/** The data of a pass: the guide, or means of it, with what leads from it back to the noisy points. */
struct Data {
  SortedVectors<float> residuals;
  MergedPoints merged; ///< empty: each point is a datum
};

SortedVectors<float>
residualsOf(PointsView noisy, const PointIndex& guide)
{
  const PointsView p = guide.sorted();
  SortedVectors<float> residuals(p.size);
  for (std::size_t k = 0; k < p.size; ++k) {
    const std::uint32_t i = guide.order()[k];
    residuals.x[k] = noisy.x[i] - p.x[k];
    residuals.y[k] = noisy.y[i] - p.y[k];
    residuals.z[k] = noisy.z[i] - p.z[k];
  }
  return residuals;
}

/** Means of the residuals of the points that each mean stands for. */
SortedVectors<float>
meanResiduals(const SortedVectors<float>& residuals, const MergedPoints& merged)
{
  SortedVectors<float> means(merged.size());
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const std::uint32_t m = merged.mean_of[k];
    means.x[m] += residuals.x[k] / merged.weights[m];
    means.y[m] += residuals.y[k] / merged.weights[m];
    means.z[m] += residuals.z[k] / merged.weights[m];
  }
  return means;
}

Data
dataOf(const SteeredFitParameters& p, PointsView noisy, const PointIndex& guide, NormalsView normals, std::size_t threads)
{
  Data data;
  data.residuals = residualsOf(noisy, guide);
  const double area_radius = p.radius * std::sqrt(p.longest_share); // of a disc as large as the neighbourhood beside an edge
  data.merged = mergePoints(guide, normals, {area_radius, nullptr}, p.merge_above, true, threads);
  if (!data.merged.empty())
    data.residuals = meanResiduals(data.residuals, data.merged);
  return data;
}

/** Sums of one task, so small that they are still in the cache when planes are fitted. */
struct Sums {
  static constexpr std::size_t kSize = kBlocksPerTask * kQueryBlock;
  AlignedArray<float> weight = AlignedArray<float>(kSize);
  SortedVectors<float> mean{kSize}, shift{kSize}, diagonal{kSize}, mixed{kSize};
};

/** The point's move onto the fitted plane of noisy heights, and that plane's normal on the side of `side`.
 * \return false where the data span no plane */
bool
fitPlane(const Sums& s, std::size_t k, const Eigen::Vector3d& side, Eigen::Vector3d& move, Eigen::Vector3d& normal)
{
  if (!(s.weight[k] >= kFewestData))
    return false;
  const double weight = s.weight[k];
  const Eigen::Vector3d mean = Eigen::Vector3d(s.mean.x[k], s.mean.y[k], s.mean.z[k]) / weight;
  Eigen::Matrix3d scatter;
  scatter << s.diagonal.x[k], s.mixed.z[k], s.mixed.y[k], //
      s.mixed.z[k], s.diagonal.y[k], s.mixed.x[k],        //
      s.mixed.y[k], s.mixed.x[k], s.diagonal.z[k];
  scatter = scatter / weight - mean * mean.transpose();
  const double size = scatter.trace();
  if (!(size > 0.0))
    return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter / size);
  if (!(solver.eigenvalues()[1] > kLineRatio * solver.eigenvalues()[2]))
    return false;
  normal = solver.eigenvectors().col(0).normalized();
  if (normal.dot(side) < 0.0)
    normal = -normal;
  move = normal.dot(Eigen::Vector3d(s.shift.x[k], s.shift.y[k], s.shift.z[k])) / weight * normal;
  return true;
}

/** One pass over the rows of `places`, which are ascending in the order of the guide. */
class Pass {
public:
  Pass(const SteeredFitParameters& parameters, PointsView noisy, MutableVectorsView positions, MutableVectorsView normals)
  : p_(parameters)
  , threads_(resolveThreads(parameters.number_of_threads))
  , guide_(positions, parameters.number_of_threads)
  , sorted_normals_(gather<float>(normals, {}, guide_.order(), 0.0f, threads_))
  , data_(dataOf(parameters, noisy, guide_, sortedNormals(), threads_))
  , positions_(positions)
  , normals_(normals)
  {}

  void
  run(const std::vector<std::uint8_t>& wanted)
  {
    const NormalTensors tensors(guide_, sortedNormals(), p_.direction_radius, threads_);
    std::vector<std::uint32_t> queries; // sorted places
    for (std::size_t k = 0; k < guide_.size(); ++k) {
      if (wanted[guide_.order()[k]] != 0)
        queries.push_back(static_cast<std::uint32_t>(k));
      if (queries.size() == kQueriesAtOnce || (k + 1 == guide_.size() && !queries.empty())) {
        fit(queries, tensors);
        queries.clear();
      }
    }
  }

private:
  /** Queries that have their arrays at one time; whole blocks. */
  static constexpr std::size_t kQueriesAtOnce = 4096;

  void
  fit(const std::vector<std::uint32_t>& queries, const NormalTensors& tensors)
  {
    const SortedVectors<float> points = gather<float>(guide_.sorted(), {}, queries, kFarAway, threads_);
    const SortedVectors<float> query_normals = gather<float>(sortedNormals(), {}, queries, 0.0f, threads_);
    const SteeredEllipsoids metrics = steeredEllipsoids(p_, tensors, queries);
    const Neighborhoods near =
        findNeighborhoods(data_.merged.empty() ? guide_.tree() : data_.merged.tree,
                          {points.x.data(), points.y.data(), points.z.data(), queries.size()}, metrics.reach_sq.data(), threads_);
    const kernels::Candidates candidates = candidatesOf(near);
    kernels::SteeredMoments a;
    a.queries = points.vectors();
    const PointsView sorted = guide_.sorted();
    a.data = data_.merged.empty() ? kernels::Vectors<float>{sorted.x, sorted.y, sorted.z} : data_.merged.positions.vectors();
    a.radius.per_query = metrics.reach_sq.data();
    a.metric_diagonal = metrics.diagonal.vectors();
    a.metric_mixed = metrics.mixed.vectors();
    a.residuals = data_.residuals.vectors();
    a.query_normals = query_normals.vectors();
    a.data_normals = data_.merged.empty() ? sorted_normals_.vectors() : data_.merged.normals.vectors();
    a.symmetry_falloff = static_cast<float>(1.0 / (1.0 - std::cos(kSymmetryAngle)));
    a.data_weight = data_.merged.empty() ? nullptr : data_.merged.weights.data();
    parallelBlocks(blockCount(queries.size()), kBlocksPerTask, threads_,
                   [&](std::size_t begin, std::size_t end) { fitBlocks(candidates, a, queries, begin, end); });
  }

  NormalsView sortedNormals() const { return {sorted_normals_.x.data(), sorted_normals_.y.data(), sorted_normals_.z.data(), guide_.size()}; }

  void
  fitBlocks(const kernels::Candidates& candidates, kernels::SteeredMoments a, const std::vector<std::uint32_t>& queries, std::size_t begin,
            std::size_t end)
  {
    Sums sums;
    a.first_output = begin * kQueryBlock;
    a.weight_sum = sums.weight.data();
    a.mean = sums.mean.vectors();
    a.shift = sums.shift.vectors();
    a.scatter_diagonal = sums.diagonal.vectors();
    a.scatter_mixed = sums.mixed.vectors();
    kernels::active().steered_moments(candidates, a, begin, end);
    for (std::size_t q = a.first_output; q < std::min(queries.size(), end * kQueryBlock); ++q)
      moveOne(sums, q - a.first_output, guide_.order()[queries[q]]);
  }

  void
  moveOne(const Sums& sums, std::size_t k, std::uint32_t row)
  {
    Eigen::Vector3d move, normal;
    if (!fitPlane(sums, k, {normals_.x[row], normals_.y[row], normals_.z[row]}, move, normal))
      return;
    positions_.x[row] = static_cast<float>(positions_.x[row] + move[0]);
    positions_.y[row] = static_cast<float>(positions_.y[row] + move[1]);
    positions_.z[row] = static_cast<float>(positions_.z[row] + move[2]);
    normals_.x[row] = static_cast<float>(normal[0]);
    normals_.y[row] = static_cast<float>(normal[1]);
    normals_.z[row] = static_cast<float>(normal[2]);
  }

  const SteeredFitParameters& p_;
  std::size_t threads_;
  PointIndex guide_; ///< a copy: results replace the guide only in the caller's arrays
  SortedVectors<float> sorted_normals_;
  Data data_;
  MutableVectorsView positions_, normals_;
};

} // namespace

void
validate(const SteeredFitParameters& p)
{
  checkRange("steered radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("direction radius", p.direction_radius, p.direction_radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("longest share", p.longest_share, p.longest_share >= 1.0, ">= 1");
  checkRange("bending weight", p.bending_weight, p.bending_weight >= 0.0, ">= 0");
}

void
fitSteeredPlanes(const SteeredFitParameters& parameters, PointsView noisy, const std::vector<std::uint32_t>& places,
                 MutableVectorsView positions, MutableVectorsView normals, const ProgressCallback& progress)
{
  validate(parameters);
  if (parameters.passes == 0)
    return;
  checkRange("steered radius", parameters.radius, parameters.radius > 0.0, "> 0");
  checkRange("direction radius", parameters.direction_radius, parameters.direction_radius > 0.0, "> 0");
  if (places.empty())
    return;
  if (*std::max_element(places.begin(), places.end()) >= noisy.size || positions.size != noisy.size || normals.size != noisy.size)
    throw InvalidParameter("a place beyond the points, or positions and normals of another number");
  std::vector<std::uint8_t> wanted(noisy.size);
  for (const std::uint32_t row : places)
    wanted[row] = 1;
  for (unsigned pass = 0; pass < parameters.passes; ++pass) {
    if (progress && !progress(static_cast<double>(pass) / parameters.passes))
      throw Cancelled();
    Pass(parameters, noisy, positions, normals).run(wanted);
  }
  if (progress && !progress(1.0))
    throw Cancelled();
}

} // namespace pcl_gpf
