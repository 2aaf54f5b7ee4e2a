// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/box_tree.h"
#include "core/analysis/pseudonormals.h"
#include "core/analysis/triangle.h"

#include <pcl_gpf/core/analysis/triangle_distance.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_gpf {
namespace {

constexpr std::uint32_t kLeafSize = 3;
constexpr std::size_t kQueriesPerBlock = 256;

std::vector<TriangleCorners>
checkedCorners(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles)
{
  if (triangles.empty())
    throw UnsuitableData("the mesh to measure against has no triangle");
  if (triangles.size() % 3 != 0 || vertices.size() % 3 != 0 ||
      triangles.size() / 3 > std::numeric_limits<std::uint32_t>::max() / 3)
    throw InvalidParameter("a mesh needs three numbers per vertex and per triangle, and fewer than 2^32 / 3 triangles");
  std::vector<TriangleCorners> corners(triangles.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t vertex = triangles[i];
    if (vertex >= vertices.size() / 3)
      throw InvalidParameter("triangle " + std::to_string(i / 3) + " names vertex " + std::to_string(vertex) + " of " +
                             std::to_string(vertices.size() / 3));
    Position& corner = corners[i / 3][i % 3];
    corner = {vertices[3 * vertex], vertices[3 * vertex + 1], vertices[3 * vertex + 2]};
    if (!isMeasurable(corner))
      throw InvalidParameter("vertex " + std::to_string(vertex) + " is not finite or larger than 1e150");
  }
  return corners;
}

BoxTree::Box
boxOf(const TriangleCorners& corners)
{
  BoxTree::Box box{corners[0], corners[0]};
  for (const Position& corner : corners)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], corner[axis]);
      box.max[axis] = std::max(box.max[axis], corner[axis]);
    }
  return box;
}

} // namespace

struct TriangleDistance::Data {
  explicit Data(const std::vector<TriangleCorners>& unordered) : normals(unordered)
  {
    std::vector<BoxTree::Box> boxes(unordered.size());
    std::transform(unordered.begin(), unordered.end(), boxes.begin(), boxOf);
    tree = BoxTree(boxes, kLeafSize);
    corners.reserve(unordered.size());
    for (const std::uint32_t triangle : tree.order())
      corners.push_back(unordered[triangle]);
  }

  Pseudonormals normals; ///< in the order of the input
  BoxTree tree;
  std::vector<TriangleCorners> corners; ///< in the order of the tree's leaves
};

TriangleDistance::TriangleDistance(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles)
: data_(std::make_shared<const Data>(checkedCorners(vertices, triangles)))
{}

TriangleDistance::Nearest
TriangleDistance::nearest(const Position& query) const
{
  double best_sq = std::numeric_limits<double>::infinity();
  std::uint32_t best_position = 0;
  TrianglePoint best;
  data_->tree.nearest(query, best_sq, [&](std::uint32_t position, double& limit_sq) {
    const TrianglePoint candidate = nearestOfTriangle(data_->corners[position], query);
    if (candidate.distance_sq < limit_sq) {
      limit_sq = candidate.distance_sq;
      best = candidate;
      best_position = position;
    }
  });
  Nearest result;
  result.triangle = data_->tree.order()[best_position];
  result.point = addScaled(query, 1.0, best.offset);
  // The offset points from the query to the surface: along the normal means inside.
  const bool inside = dot(best.offset, data_->normals.at(result.triangle, best.feature)) > 0;
  result.signed_distance = inside ? -length(best.offset) : length(best.offset);
  return result;
}

std::vector<double>
TriangleDistance::signedDistances(const std::vector<Position>& queries, unsigned number_of_threads) const
{
  std::vector<double> result(queries.size(), std::numeric_limits<double>::quiet_NaN());
  parallelBlocks(queries.size(), kQueriesPerBlock, resolveThreads(number_of_threads),
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i)
                     if (isMeasurable(queries[i]))
                       result[i] = nearest(queries[i]).signed_distance;
                 });
  return result;
}

} // namespace pcl_gpf
