// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/normal_estimation.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_gpf {
namespace {

constexpr unsigned kFewestNeighbors = 3; // a plane

void
check(const NormalEstimationParameters& parameters)
{
  if (!(parameters.radius >= 0) || !std::isfinite(parameters.radius))
    throw InvalidParameter("radius = " + std::to_string(parameters.radius) + ": must be >= 0 and finite");
  if (parameters.radius == 0 && parameters.neighbors < kFewestNeighbors)
    throw InvalidParameter("neighbors = " + std::to_string(parameters.neighbors) + ": must be >= 3");
}

} // namespace

NormalEstimationParameters
detail::inFrame(NormalEstimationParameters parameters, const LocalFrame& frame)
{
  constexpr double kSmallest = 1e-15, kLargest = 1e16; // extents; floats hold their squares
  if (parameters.radius > 0 && std::isfinite(parameters.radius))
    parameters.radius = std::clamp(frame.lengthToLocal(parameters.radius), kSmallest, kLargest);
  return parameters;
}

pcl::PointCloud<pcl::Normal>
estimateNormalsOfFinitePoints(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points,
                              const Eigen::Vector3f& viewpoint,
                              const NormalEstimationParameters& parameters)
{
  try {
    check(parameters);
  }
  catch (...) {
    rethrowAsPclException("estimateNormals");
  }
  pcl::PointCloud<pcl::Normal> normals;
  if (points->empty()) // PCL's tree crashes on a query after an empty cloud
    return normals;
  const auto threads = static_cast<unsigned>(resolveThreads(parameters.number_of_threads));
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(threads);
  estimation.setInputCloud(points);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  estimation.setViewPoint(viewpoint.x(), viewpoint.y(), viewpoint.z());
  if (parameters.radius > 0)
    estimation.setRadiusSearch(parameters.radius);
  else
    estimation.setKSearch(static_cast<int>(std::min<std::size_t>(parameters.neighbors, points->size()))); // PCL counts in int
  estimation.compute(normals);
  return normals;
}

} // namespace pcl_gpf
