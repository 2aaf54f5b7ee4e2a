// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/box_tree.h"

#include <pcl_gpf/core/analysis/point_distance.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <limits>

namespace pcl_gpf {
namespace {

constexpr std::uint32_t kLeafSize = 8;
constexpr std::size_t kQueriesPerBlock = 512;

} // namespace

struct PointDistance::Data {
  BoxTree tree;
  std::vector<Position> points;    ///< in the order of the tree's leaves
  std::vector<std::uint32_t> rows; ///< row of each in the input
};

PointDistance::PointDistance(const std::vector<Position>& points)
{
  if (points.size() > std::numeric_limits<std::uint32_t>::max())
    throw UnsuitableData("a cloud to measure against can have at most 2^32 - 1 points");
  std::vector<BoxTree::Box> boxes;
  std::vector<std::uint32_t> rows;
  for (std::size_t row = 0; row < points.size(); ++row)
    if (isMeasurable(points[row])) {
      boxes.push_back({points[row], points[row]});
      rows.push_back(static_cast<std::uint32_t>(row));
    }
  if (boxes.empty())
    throw UnsuitableData("the cloud to measure against has no finite point");

  auto data = std::make_shared<Data>();
  data->tree = BoxTree(boxes, kLeafSize);
  for (const std::uint32_t item : data->tree.order()) {
    data->points.push_back(boxes[item].min);
    data->rows.push_back(rows[item]);
  }
  data_ = std::move(data);
}

PointDistance::Nearest
PointDistance::nearest(const Position& query) const
{
  double best_sq = std::numeric_limits<double>::infinity();
  std::uint32_t best = 0;
  data_->tree.nearest(query, best_sq, [&](std::uint32_t position, double& limit_sq) {
    const Position offset = subtract(data_->points[position], query);
    const double distance_sq = dot(offset, offset);
    if (distance_sq < limit_sq) {
      limit_sq = distance_sq;
      best = position;
    }
  });
  return {data_->rows[best], length(subtract(data_->points[best], query))};
}

std::vector<double>
PointDistance::distances(const std::vector<Position>& queries, unsigned number_of_threads) const
{
  std::vector<double> result(queries.size(), std::numeric_limits<double>::quiet_NaN());
  parallelBlocks(queries.size(), kQueriesPerBlock, resolveThreads(number_of_threads),
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i)
                     if (isMeasurable(queries[i]))
                       result[i] = nearest(queries[i]).distance;
                 });
  return result;
}

} // namespace pcl_gpf
