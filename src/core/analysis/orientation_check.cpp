// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/orientation_check.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/normal_orientation.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr std::size_t kNeighbors = 8;
constexpr double kMostInconsistent = 0.1;
/** Fewer points do not tell which sign is right at the edges between them. */
constexpr std::size_t kFewestPoints = 500;

using Links = std::vector<std::array<std::uint32_t, kNeighbors>>;

Links
nearestNeighbors(const PointIndex& points, std::size_t threads)
{
  const PointsView view = points.sorted();
  Links links(view.size);
  parallelBlocks(view.size, 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<float> distances_sq;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = begin; i < end; ++i) {
      points.tree().nearest(view, {view.x[i], view.y[i], view.z[i]}, kNeighbors, distances_sq, &indices);
      links[i].fill(static_cast<std::uint32_t>(i));
      std::copy(indices.begin(), indices.end(), links[i].begin());
    }
  });
  return links;
}

/** Least point of the connected part of every point. */
std::vector<std::uint32_t>
connectedParts(const Links& links)
{
  std::vector<std::uint32_t> parent(links.size());
  std::iota(parent.begin(), parent.end(), std::uint32_t{0});
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::uint32_t i = 0; i < links.size(); ++i)
    for (const std::uint32_t j : links[i]) {
      const std::uint32_t a = root(i), b = root(j);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t i = 0; i < parent.size(); ++i)
    parent[i] = root(i);
  return parent;
}

} // namespace

double
inconsistentOrientation(const PointIndex& points, NormalsView normals, unsigned number_of_threads)
{
  const std::size_t count = points.size();
  if (count == 0)
    return 0.0;
  SoaBuffer oriented(count);
  std::copy_n(normals.x, count, oriented.x.data());
  std::copy_n(normals.y, count, oriented.y.data());
  std::copy_n(normals.z, count, oriented.z.data());
  NormalOrientationParameters parameters;
  parameters.number_of_threads = number_of_threads;
  orientNormals(parameters, points, oriented.view());

  const std::vector<std::uint32_t> part = connectedParts(nearestNeighbors(points, resolveThreads(number_of_threads)));
  std::vector<std::size_t> size(count), flipped(count);
  for (std::size_t i = 0; i < count; ++i) {
    ++size[part[i]];
    flipped[part[i]] += normals.x[i] * oriented.x[i] + normals.y[i] * oriented.y[i] + normals.z[i] * oriented.z[i] < 0.0f;
  }
  std::size_t minority = 0;
  for (std::size_t i = 0; i < count; ++i)
    minority += std::min(flipped[i], size[i] - flipped[i]);
  return static_cast<double>(minority) / static_cast<double>(count);
}

void
requireConsistentOrientation(PointsView points, NormalsView normals, unsigned number_of_threads)
{
  if (points.size < kFewestPoints)
    return;
  const PointIndex index(points, number_of_threads);
  SoaBuffer sorted(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) {
    sorted.x[k] = normals.x[index.order()[k]];
    sorted.y[k] = normals.y[index.order()[k]];
    sorted.z[k] = normals.z[index.order()[k]];
  }
  const double share = inconsistentOrientation(index, sorted.view(), number_of_threads);
  if (share >= kMostInconsistent)
    throw InvalidParameter("the normals are not oriented consistently: " + toText(std::round(share * 1000.0) / 10.0) +
                           " % of them contradict the rest of their surface; orient them before, with pcl_gpf::NormalOrientation or "
                           "pcl_gpf::orientNormals() (pcl_gpf_tool orient)");
}

} // namespace pcl_gpf
