// SPDX-License-Identifier: BSD-3-Clause
#include "steered_guide.h"

#include <pcl_gpf/core/point_index.h>

#include "../merged_points.h"

#include <cmath>
#include <utility>

namespace pcl_gpf {

namespace {

/** From each datum to the mean of its noisy points. A mean lies at the mean of its filtered points. */
SortedVectors<float>
residualsOf(const SteeredGuide& guide, PointsView noisy, PointsView positions)
{
  SortedVectors<float> residuals(guide.size());
  for (std::size_t k = 0; k < guide.order.size(); ++k) {
    const std::size_t row = guide.order[k], datum = guide.datumOf(k);
    const float weight = guide.merged() ? guide.weights[datum] : 1.0f;
    residuals.x[datum] += (noisy.x[row] - positions.x[row]) / weight;
    residuals.y[datum] += (noisy.y[row] - positions.y[row]) / weight;
    residuals.z[datum] += (noisy.z[row] - positions.z[row]) / weight;
  }
  return residuals;
}

} // namespace

SteeredGuide
steeredGuide(const SteeredFitParameters& p, PointsView noisy, PointsView positions, NormalsView normals, std::size_t threads)
{
  SteeredGuide guide;
  const PointIndex index(positions, static_cast<unsigned>(threads));
  guide.order = index.order();
  guide.normals = gather<float>(normals, {}, guide.order, 0.0f, threads);
  const NormalsView sorted_normals = {guide.normals.x.data(), guide.normals.y.data(), guide.normals.z.data(), index.size()};
  const double area_radius = p.radius * std::sqrt(p.longest_share); // of a disc as large as the neighbourhood beside an edge
  MergedPoints merged = mergePoints(index, sorted_normals, {area_radius, nullptr}, p.merge_above, true, threads);
  if (merged.empty()) {
    guide.positions = gather<float>(positions, {}, guide.order, kFarAway, threads);
    guide.tree = index.tree();
  } else {
    guide.positions = std::move(merged.positions);
    guide.normals = std::move(merged.normals);
    guide.weights = std::move(merged.weights);
    guide.mean_of = std::move(merged.mean_of);
    guide.tree = std::move(merged.tree);
  }
  guide.residuals = residualsOf(guide, noisy, positions);
  return guide;
}

} // namespace pcl_gpf
