// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/nearest_source.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>

namespace pcl_gpf {

namespace {

constexpr std::size_t kNeighbors = 8;
constexpr float kSameSide = 0.5f; // cosine
constexpr std::size_t kPositionsPerTask = 4096;

} // namespace

std::vector<std::uint32_t>
nearestOnSameSide(PointsView sources, NormalsView source_normals, PointsView positions, NormalsView normals, unsigned number_of_threads)
{
  if (sources.size == 0)
    return {};
  const PointIndex index(sources, number_of_threads);
  std::vector<std::uint32_t> result(positions.size);
  parallelBlocks(positions.size, kPositionsPerTask, resolveThreads(number_of_threads), [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    std::vector<std::uint32_t> found;
    for (std::size_t i = begin; i < end; ++i) {
      index.tree().nearest(index.sorted(), {positions.x[i], positions.y[i], positions.z[i]}, kNeighbors, distances_sq, &found);
      result[i] = index.order()[found.front()];
      for (const std::uint32_t candidate : found) {
        const std::uint32_t source = index.order()[candidate];
        const float cosine = source_normals.x[source] * normals.x[i] + source_normals.y[source] * normals.y[i] +
                             source_normals.z[source] * normals.z[i];
        if (cosine > kSameSide) {
          result[i] = source;
          break;
        }
      }
    }
  });
  return result;
}

} // namespace pcl_gpf
