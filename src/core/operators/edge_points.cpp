// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/operators/edge_points.h>
#include <pcl_gpf/core/parallel.h>

#include "../check_range.h"
#include "filtered_cloud_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace pcl_gpf {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/** Least share and number of neighbours on a face. */
constexpr double kLeastShare = 0.05;
constexpr std::size_t kFewestOnFace = 3;
/** Faces that may meet in one ball. */
constexpr std::size_t kMostFaces = 3;
/** Normals that are tried as that of a face. */
constexpr std::size_t kCandidates = 16;

/** A datum in the ball about a point, relative to it. */
struct Neighbor {
  Eigen::Vector3f offset, normal;
};

struct Plane {
  Eigen::Vector3d through, normal;
};

/** Moves the neighbours that face as `normal` does, up to sign, behind the others, the order kept: sums follow it. \return the end of the others */
std::vector<Neighbor>::iterator
separate(std::vector<Neighbor>& neighbors, const Eigen::Vector3f& normal, float least_cosine)
{
  return std::stable_partition(neighbors.begin(), neighbors.end(),
                               [&](const Neighbor& n) { return !(std::abs(n.normal.dot(normal)) > least_cosine); });
}

Plane
meanPlane(std::vector<Neighbor>::const_iterator begin, std::vector<Neighbor>::const_iterator end, const Eigen::Vector3f& direction)
{
  Plane plane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (auto n = begin; n != end; ++n) {
    plane.through += n->offset.cast<double>();
    plane.normal += (n->normal.dot(direction) < 0.0f ? -1.0 : 1.0) * n->normal.cast<double>();
  }
  plane.through /= static_cast<double>(end - begin);
  plane.normal.normalize();
  return plane;
}

/** The one of a few of the normals with which most others agree. */
Eigen::Vector3f
commonNormal(const std::vector<Neighbor>& neighbors, float least_cosine)
{
  std::size_t best = 0, most = 0;
  const std::size_t step = std::max<std::size_t>(1, neighbors.size() / kCandidates);
  for (std::size_t j = 0; j < neighbors.size(); j += step) {
    std::size_t votes = 0;
    for (const Neighbor& n : neighbors)
      votes += std::abs(n.normal.dot(neighbors[j].normal)) > least_cosine;
    if (votes > most) {
      most = votes;
      best = j;
    }
  }
  return neighbors[best].normal;
}

/** Squared distance from the origin to the line in which two planes meet. */
double
lineDistanceSq(const Plane& a, const Plane& b)
{
  const double cosine = a.normal.dot(b.normal), sine_sq = 1.0 - cosine * cosine;
  if (!(sine_sq > 1e-12))
    return std::numeric_limits<double>::infinity();
  const double from_a = a.through.dot(a.normal), from_b = b.through.dot(b.normal);
  return (from_a * from_a + from_b * from_b - 2.0 * cosine * from_a * from_b) / sine_sq;
}

/** Whether two faces in the ball meet within `reach` of its centre. \param[in,out] neighbors used up */
bool
facesMeet(std::vector<Neighbor>& neighbors, const Eigen::Vector3f& normal, double reach, float least_cosine)
{
  const std::size_t least = std::max(kFewestOnFace, static_cast<std::size_t>(std::ceil(kLeastShare * static_cast<double>(neighbors.size()))));
  std::vector<Plane> faces;
  Eigen::Vector3f direction = normal;
  for (std::size_t tries = 0; tries <= kMostFaces && neighbors.size() >= least; ++tries) {
    const auto face = separate(neighbors, direction, least_cosine);
    const auto members = static_cast<std::size_t>(neighbors.end() - face);
    if (members < least && tries > 0)
      break;
    if (members >= least) { // else the point has a normal of its own and belongs to no face
      faces.push_back(meanPlane(face, neighbors.end(), direction));
      for (std::size_t f = 0; f + 1 < faces.size(); ++f)
        if (lineDistanceSq(faces[f], faces.back()) <= reach * reach)
          return true;
      neighbors.erase(face, neighbors.end());
    }
    if (neighbors.size() >= least)
      direction = commonNormal(neighbors, least_cosine);
  }
  return false;
}

/** The data in the ball about sorted point `k`. */
void
collectNeighbors(const FilteredCloudIndex& cloud, const Neighborhoods& near, double radius, std::size_t k, std::vector<Neighbor>& neighbors)
{
  const PointsView points = cloud.points.sorted();
  const auto radius_sq = static_cast<float>(radius * radius);
  neighbors.clear();
  const std::size_t block = k / kQueryBlock;
  for (std::size_t r = near.run_offsets[block]; r < near.run_offsets[block + 1]; ++r)
    for (std::uint32_t j = near.runs[r].begin; j < near.runs[r].end; ++j) {
      const Eigen::Vector3f offset(cloud.data.x[j] - points.x[k], cloud.data.y[j] - points.y[k], cloud.data.z[j] - points.z[k]);
      if (offset.squaredNorm() < radius_sq)
        neighbors.push_back({offset, {cloud.data_normals.x[j], cloud.data_normals.y[j], cloud.data_normals.z[j]}});
    }
}

/** Points about which nearly all normals agree have no edge near them: no need to look further. */
AlignedArray<float>
agreement(const FilteredCloudIndex& cloud, const Neighborhoods& near, double radius, double angle)
{
  const std::size_t size = cloud.points.size();
  const AlignedArray<float> no_field(cloud.data.size() + kQueryBlock);
  AlignedArray<float> count(size + kQueryBlock), weight(size + kQueryBlock), unused(size + kQueryBlock);
  kernels::FieldSums a = cloud.sums(radius, angle);
  a.first_field = a.second_field = no_field.data();
  a.count = count.data();
  a.weight_sum = weight.data();
  a.first_sum = a.second_sum = unused.data();
  const kernels::Candidates candidates = candidatesOf(near);
  parallelBlocks(blockCount(size), kBlocksPerTask, cloud.threads,
                 [&](std::size_t begin, std::size_t end) { kernels::active().field_sums(candidates, a, begin, end); });
  for (std::size_t k = 0; k < size; ++k)
    weight[k] = count[k] > 0.0f ? weight[k] / count[k] : 1.0f;
  return weight;
}

} // namespace

std::vector<std::uint8_t>
edgePoints(const EdgePointsParameters& p, PointsView positions, NormalsView normals)
{
  checkRange("support_radius", p.support_radius, p.support_radius > 0.0, "> 0");
  checkRange("spacing", p.spacing, p.spacing > 0.0, "> 0");
  checkRange("angle", p.angle, p.angle > 0.0 && p.angle < 90.0, "> 0 and < 90");
  std::vector<std::uint8_t> edge(positions.size);
  if (positions.size == 0)
    return edge;
  const double radius = boundedRadius(0.5 * p.support_radius), angle = p.angle * kDegree;
  const FilteredCloudIndex cloud(positions, normals, radius, p.spacing, p.number_of_threads);
  const Neighborhoods near = cloud.neighborhoods(radius);
  // Weights are at most 1/e beyond the angle: where another face has its share, the mean weight is below this.
  const auto one_face = static_cast<float>(1.0 - kLeastShare * (1.0 - std::exp(-1.0)));
  const AlignedArray<float> agreeing = agreement(cloud, near, radius, angle);
  const auto least_cosine = static_cast<float>(std::cos(angle));
  parallelBlocks(blockCount(positions.size), kBlocksPerTask, cloud.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> neighbors;
    for (std::size_t k = begin * kQueryBlock; k < std::min(positions.size, end * kQueryBlock); ++k) {
      if (agreeing[k] > one_face + 1e-5f)
        continue;
      collectNeighbors(cloud, near, radius, k, neighbors);
      const Eigen::Vector3f normal(cloud.normals.x[k], cloud.normals.y[k], cloud.normals.z[k]);
      edge[cloud.points.order()[k]] = facesMeet(neighbors, normal, 0.5 * radius, least_cosine);
    }
  });
  return edge;
}

} // namespace pcl_gpf
