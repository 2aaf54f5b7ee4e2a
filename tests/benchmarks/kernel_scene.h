// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models.h"

#include "core/sorted_points.h"

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/point_index.h>

#include <cmath>
#include <vector>

/** \file
 * \brief What the kernels are measured on: a noisy block that fits the caches, and arrays for their sums.
 */
namespace pcl_gpf::benchmark_scene {

constexpr std::size_t kPoints = 20000;
constexpr double kNeighbors = 60;

/** A cloud in sorted order with the runs of its balls; every kernel sums over the same pairs. */
template <typename Real>
struct Scene {
  SortedVectors<Real> points, normals;
  AlignedArray<Real> ones;
  Neighborhoods near;
  double radius = 0, pairs = 0, candidates = 0;

  Scene()
  {
    const test::Shape shape = benchmark_models::makeModel("block", kPoints, 1.0);
    BoundingBox box;
    for (const test::Vector3& p : shape.points)
      box.add(p[0], p[1], p[2]);
    const LocalFrame frame = localFrame(box);
    SoaBuffer local(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) {
      local.x[i] = frame.toLocal(shape.points[i][0], 0);
      local.y[i] = frame.toLocal(shape.points[i][1], 1);
      local.z[i] = frame.toLocal(shape.points[i][2], 2);
    }
    const PointIndex index(local.view(), 1);
    points = gather<Real>(local.view(), {}, index.order(), Real(kFarAway));
    normals = SortedVectors<Real>(kPoints);
    for (std::size_t i = 0; i < kPoints; ++i) {
      const test::Vector3& n = shape.normals[index.order()[i]];
      normals.x[i] = static_cast<Real>(n[0]);
      normals.y[i] = static_cast<Real>(n[1]);
      normals.z[i] = static_cast<Real>(n[2]);
    }
    ones = AlignedArray<Real>(kPoints + kQueryBlock, Real(1));
    radius = radiusFor(index);
    near = findNeighborhoods(index.tree(), index.sorted(), radius, 1);
    for (std::size_t block = 0; block + 1 < near.run_offsets.size(); ++block)
      for (std::size_t r = near.run_offsets[block]; r < near.run_offsets[block + 1]; ++r)
        candidates += static_cast<double>(kQueryBlock * (near.runs[r].end - near.runs[r].begin));
  }

private:
  /** Mean distance of the last of `kNeighbors`; counts the pairs within it. */
  double
  radiusFor(const PointIndex& index)
  {
    const PointsView p = index.sorted();
    std::vector<float> distances_sq;
    double sum = 0;
    constexpr std::size_t kStep = 50;
    for (std::size_t i = 0; i < kPoints; i += kStep) {
      index.tree().nearest(p, {p.x[i], p.y[i], p.z[i]}, static_cast<std::size_t>(kNeighbors), distances_sq);
      sum += std::sqrt(static_cast<double>(distances_sq.back())) * kStep / kPoints;
    }
    std::vector<Run> runs;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::array<float, 3> q = {p.x[i], p.y[i], p.z[i]};
      runs.clear();
      index.tree().collectRuns({q, q}, static_cast<float>(sum), runs);
      for (const Run& run : runs)
        for (std::size_t j = run.begin; j < run.end; ++j) {
          const float dx = p.x[j] - q[0], dy = p.y[j] - q[1], dz = p.z[j] - q[2];
          pairs += static_cast<double>(dx * dx + dy * dy + dz * dz) < sum * sum;
        }
    }
    return sum;
  }
};

template <typename Real>
const Scene<Real>&
scene()
{
  static const Scene<Real> made;
  return made;
}

/** Output arrays by the dozen. */
template <typename Real>
struct Sums {
  std::vector<AlignedArray<Real>> arrays;

  Real*
  one()
  {
    arrays.emplace_back(kPoints + kQueryBlock);
    return arrays.back().data();
  }
  kernels::MutableVectors<Real>
  three()
  {
    Real* const x = one();
    Real* const y = one();
    return {x, y, one()};
  }
};

} // namespace pcl_gpf::benchmark_scene
