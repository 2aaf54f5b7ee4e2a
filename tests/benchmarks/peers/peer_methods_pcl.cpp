// SPDX-License-Identifier: BSD-3-Clause
#include "peer_checks.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl_gpf::benchmark_peers {

namespace {

using Centre = std::array<double, 3>;

/** PCL computes in float: coordinates relative to the first point keep their digits. */
Centre
centreOf(const PeerCloud& cloud)
{
  return {cloud.x.front(), cloud.y.front(), cloud.z.front()};
}

pcl::PointCloud<pcl::PointXYZ>::Ptr
pack(const PeerCloud& cloud, const Centre& centre)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr packed(new pcl::PointCloud<pcl::PointXYZ>);
  packed->reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    packed->push_back({static_cast<float>(cloud.x[i] - centre[0]), static_cast<float>(cloud.y[i] - centre[1]),
                       static_cast<float>(cloud.z[i] - centre[2])});
  return packed;
}

void
resize(PeerCloud& cloud, std::size_t size)
{
  for (std::vector<double>* values : {&cloud.x, &cloud.y, &cloud.z, &cloud.normal_x, &cloud.normal_y, &cloud.normal_z})
    values->resize(size);
}

} // namespace

void
estimateNormalsPcl(PeerCloud& cloud, unsigned neighbors, unsigned threads)
{
  requireNeighbors(cloud, neighbors, 3);
  requireThreads(threads);
  const Centre centre = centreOf(cloud);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(threads);
  estimation.setInputCloud(pack(cloud, centre));
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(static_cast<int>(neighbors));
  estimation.setViewPoint(static_cast<float>(-centre[0]), static_cast<float>(-centre[1]), static_cast<float>(-centre[2]));
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  resize(cloud, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.normal_x[i] = static_cast<double>(normals[i].normal_x);
    cloud.normal_y[i] = static_cast<double>(normals[i].normal_y);
    cloud.normal_z[i] = static_cast<double>(normals[i].normal_z);
  }
}

PclMlsResult
pclMovingLeastSquares(const PeerCloud& cloud, double radius, unsigned threads)
{
  require(cloud.size() >= 3, "moving least squares need at least three points");
  require(radius > 0.0, "the radius must be positive");
  requireThreads(threads);
  const Centre centre = centreOf(cloud);
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> mls;
  mls.setInputCloud(pack(cloud, centre));
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  mls.setPolynomialOrder(2);
  mls.setComputeNormals(true);
  mls.setSearchRadius(radius);
  mls.setNumberOfThreads(threads);
  if (threads == 1)
    mls.setCacheMLSResults(false); // saves memory; with several threads PCL 1.13 writes all results into one place
  pcl::PointCloud<pcl::PointNormal> smoothed;
  mls.process(smoothed);

  // Several threads put their points out in an order that changes from run to run.
  const pcl::Indices& sources = mls.getCorrespondingIndices()->indices;
  std::vector<std::size_t> order(smoothed.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sources[a] < sources[b]; });
  PclMlsResult result;
  resize(result.cloud, smoothed.size());
  result.sources.resize(smoothed.size());
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const pcl::PointNormal& p = smoothed[order[i]];
    result.cloud.x[i] = static_cast<double>(p.x) + centre[0];
    result.cloud.y[i] = static_cast<double>(p.y) + centre[1];
    result.cloud.z[i] = static_cast<double>(p.z) + centre[2];
    result.cloud.normal_x[i] = static_cast<double>(p.normal_x);
    result.cloud.normal_y[i] = static_cast<double>(p.normal_y);
    result.cloud.normal_z[i] = static_cast<double>(p.normal_z);
    result.sources[i] = static_cast<std::uint32_t>(sources[order[i]]);
  }
  return result;
}

} // namespace pcl_gpf::benchmark_peers
