// SPDX-License-Identifier: BSD-3-Clause
// A program of a user: clouds cross the border between libpcl, pcl_gpf and this file in every direction.
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/filters/bilateral_normal_filter.h>
#include <pcl_gpf/filters/gpf.h>
#include <pcl_gpf/version.h>

#include <pcl/common/io.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>

using Cloud = pcl::PointCloud<pcl::PointNormal>;

static Cloud::Ptr
noisyPlane()
{
  auto cloud = pcl::make_shared<Cloud>();
  pcl_gpf::SplitMix64 random(1);
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 60; ++column) {
      pcl::PointNormal point;
      point.x = 0.01f * static_cast<float>(column);
      point.y = 0.01f * static_cast<float>(row);
      point.z = 0.004f * static_cast<float>(random.normal());
      point.normal_z = 1.0f;
      cloud->push_back(point);
    }
  return cloud;
}

static double
roughness(const Cloud& cloud)
{
  double sum = 0;
  for (const auto& point : cloud)
    sum += point.z * point.z;
  return std::sqrt(sum / static_cast<double>(cloud.size()));
}

int
main()
{
  const Cloud::Ptr input = noisyPlane();

  pcl::StatisticalOutlierRemoval<pcl::PointNormal> outliers;
  outliers.setInputCloud(input);
  outliers.setMeanK(10);
  outliers.setStddevMulThresh(5.0);
  auto cleaned = pcl::make_shared<Cloud>();
  outliers.filter(*cleaned);

  pcl_gpf::BilateralNormalFilter<pcl::PointNormal> normals;
  normals.setInputCloud(cleaned);
  auto smoothed = pcl::make_shared<Cloud>();
  normals.filter(*smoothed);

  pcl_gpf::GPF<pcl::PointNormal> gpf;
  gpf.setInputCloud(smoothed);
  auto filtered = pcl::make_shared<Cloud>();
  gpf.filter(*filtered);

  pcl::VoxelGrid<pcl::PointNormal> grid;
  grid.setInputCloud(filtered);
  grid.setLeafSize(0.05f, 0.05f, 0.05f);
  Cloud thinned;
  grid.filter(thinned);

  pcl::PointCloud<pcl::PointXYZ> points;
  pcl::copyPointCloud(*filtered, points);
  thinned.resize(2 * thinned.size());
  filtered->reserve(2 * filtered->size());

  std::printf("pcl_gpf %s: %zu of %zu points, roughness %.5f -> %.5f\n", PCL_GPF_VERSION, points.size(), input->size(),
              roughness(*input), roughness(*filtered));
  const bool good =
    filtered->size() == cleaned->size() && !thinned.empty() && roughness(*filtered) < 0.5 * roughness(*input);
  return good ? 0 : 1;
}
