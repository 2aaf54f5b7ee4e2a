// SPDX-License-Identifier: BSD-3-Clause
#include "steered_planes.h"

#include <pcl_gpf/core/parallel.h>

#include "eigen_vectors.h"
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

/** Sums of one task, so small that they are still in the cache when planes are fitted. */
struct Sums {
  static constexpr std::size_t kSize = kBlocksPerTask * kQueryBlock;
  AlignedArray<float> weight = AlignedArray<float>(kSize);
  SortedVectors<float> mean{kSize}, shift{kSize}, diagonal{kSize}, mixed{kSize};
};

/** The query's move onto the fitted plane of noisy heights, and that plane's normal on the side of `side`.
 * \return false where the data span no plane */
bool
fitPlane(const Sums& s, std::size_t k, const Eigen::Vector3d& side, Eigen::Vector3d& move, Eigen::Vector3d& normal)
{
  if (!(s.weight[k] >= kFewestData))
    return false;
  const double weight = s.weight[k];
  const Eigen::Vector3d mean = vectorAt(s.mean, k) / weight;
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
  move = normal.dot(vectorAt(s.shift, k)) / weight * normal;
  return true;
}

/** Sums over some blocks of queries and the planes of these. */
void
fitBlocks(const kernels::Candidates& candidates, kernels::SteeredMoments a, const SteeredQueries& queries, std::size_t begin,
          std::size_t end, SteeredMoves& moves)
{
  Sums sums;
  a.first_output = begin * kQueryBlock;
  a.weight_sum = sums.weight.data();
  a.mean = sums.mean.vectors();
  a.shift = sums.shift.vectors();
  a.scatter_diagonal = sums.diagonal.vectors();
  a.scatter_mixed = sums.mixed.vectors();
  kernels::active().steered_moments(candidates, a, begin, end);
  for (std::size_t q = a.first_output; q < std::min(queries.data.size(), end * kQueryBlock); ++q) {
    Eigen::Vector3d move, normal;
    if (!fitPlane(sums, q - a.first_output, vectorAt(queries.normals, q), move, normal))
      continue;
    setVector(move, moves.moves, q);
    setVector(normal, moves.normals, q);
  }
}

} // namespace

SteeredMoves
fitPlanes(const SteeredFitParameters& parameters, const SteeredGuide& guide, const NormalTensors& tensors,
          const SteeredQueries& queries, std::size_t threads)
{
  const std::size_t count = queries.data.size();
  const SortedVectors<float>& p = queries.positions;
  const SteeredEllipsoids metrics = steeredEllipsoids(parameters, tensors, queries.data);
  const Neighborhoods near =
      findNeighborhoods(guide.tree, {p.x.data(), p.y.data(), p.z.data(), count}, metrics.reach_sq.data(), threads);
  kernels::SteeredMoments a;
  a.queries = p.vectors();
  a.query_normals = queries.normals.vectors();
  a.radius.per_query = metrics.reach_sq.data();
  a.metric_diagonal = metrics.diagonal.vectors();
  a.metric_mixed = metrics.mixed.vectors();
  a.data = guide.positions.vectors();
  a.data_normals = guide.normals.vectors();
  a.residuals = guide.residuals.vectors();
  a.data_weight = guide.weights.empty() ? nullptr : guide.weights.data();
  a.symmetry_falloff = static_cast<float>(1.0 / (1.0 - std::cos(kSymmetryAngle)));
  SteeredMoves moves{SortedVectors<float>(count), SortedVectors<float>(count)};
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(count), kBlocksPerTask, threads,
                 [&](std::size_t begin, std::size_t end) { fitBlocks(candidates, a, queries, begin, end, moves); });
  return moves;
}

} // namespace pcl_gpf
