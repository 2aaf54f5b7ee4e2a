// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/bilateral_normals.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "normal_rounds.h"

#include <chrono>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kPointsPerTask = 8192;

SortedVectors<float>
unitVectors(VectorsView normals, std::size_t threads)
{
  SortedVectors<float> unit(normals.size);
  const auto one = [&](std::size_t i) {
    const double x = normals.x[i], y = normals.y[i], z = normals.z[i];
    const double length = std::sqrt(x * x + y * y + z * z);
    // A unit vector stays what it is to the last bit.
    const double scale = length > 0.0 && std::abs(length - 1.0) > 1e-6 ? 1.0 / length : 1.0;
    unit.x[i] = static_cast<float>(x * scale);
    unit.y[i] = static_cast<float>(y * scale);
    unit.z[i] = static_cast<float>(z * scale);
  };
  parallelBlocks(normals.size, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      one(i);
  });
  return unit;
}

} // namespace

void
validate(const BilateralNormalsParameters& p)
{
  checkRange("bilateral radius", p.radius, p.radius >= 0.0, ">= 0, 0 = estimated");
  checkRange("bilateral neighbors", p.neighbors, p.neighbors == 0 || (p.neighbors >= 3 && p.neighbors <= 1000), "0 or 3 .. 1000");
  checkRange("bilateral angle", p.angle, p.angle > 0.0 && p.angle <= 90.0, "0 < angle <= 90 degrees");
  checkRange("bilateral iterations", p.iterations, p.iterations <= 1000, "0 .. 1000");
  if (p.radius > 0.0 && p.neighbors > 0)
    throw InvalidParameter("bilateral radius and neighbors exclude each other; both are set");
}

BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters, PointsView points, MutableVectorsView normals,
                         const NeighborSearch& search, const ProgressCallback& progress)
{
  const PointIndex index(points, parameters.number_of_threads);
  SoaBuffer sorted(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    sorted.x[k] = normals.x[index.order()[k]];
    sorted.y[k] = normals.y[index.order()[k]];
    sorted.z[k] = normals.z[index.order()[k]];
  }
  BilateralNormalsStatistics statistics = filterNormalsBilaterally(parameters, index, sorted.view(), search, progress);
  for (std::size_t k = 0; k < index.size(); ++k) {
    normals.x[index.order()[k]] = sorted.x[k];
    normals.y[index.order()[k]] = sorted.y[k];
    normals.z[index.order()[k]] = sorted.z[k];
  }
  return statistics;
}

BilateralNormalsStatistics
filterNormalsBilaterally(const BilateralNormalsParameters& parameters, const PointIndex& points, MutableVectorsView normals,
                         const NeighborSearch& search, const ProgressCallback& progress)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  if (parameters.radius <= 0.0 && parameters.neighbors == 0)
    throw InvalidParameter("bilateral radius or neighbors must be set; both are 0");
  refuseExcessiveWork(estimateWork(parameters, points, search && parameters.neighbors == 0));
  SortedVectors<float> current = unitVectors(normals, resolveThreads(parameters.number_of_threads));
  const std::size_t count = points.size();
  BilateralNormalsStatistics statistics;
  NormalRounds(parameters, points, progress).run(current, search, statistics);
  std::copy_n(current.x.data(), count, normals.x);
  std::copy_n(current.y.data(), count, normals.y);
  std::copy_n(current.z.data(), count, normals.z);
  if (progress && !progress(1.0))
    throw Cancelled();
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return statistics;
}

} // namespace pcl_gpf
