// SPDX-License-Identifier: BSD-3-Clause
// GPF in a PCL program: three lines.
#include <pcl_gpf/filters/gpf.h>

#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>
#include <random>

int
main()
{
  // A cloud with normals, here a rough floor; yours comes from a file or a sensor.
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  std::mt19937 random;
  std::normal_distribution<float> noise(0.0f, 0.005f);
  for (int i = 0; i < 10000; ++i) {
    pcl::PointNormal point;
    point.x = 0.01f * static_cast<float>(i % 100);
    point.y = 0.01f * static_cast<float>(i / 100);
    point.z = noise(random);
    point.normal_z = 1;
    cloud->push_back(point);
  }

  pcl_gpf::GPF<pcl::PointNormal> gpf;
  gpf.setInputCloud(cloud);
  gpf.filter(*cloud);

  double sum = 0;
  for (const pcl::PointNormal& point : *cloud)
    sum += point.z * point.z;
  const double roughness = std::sqrt(sum / static_cast<double>(cloud->size()));
  const double radius = gpf.getStatistics().support_radius;
  std::printf("%zu points, support radius %.3f, roughness 0.0050 -> %.4f\n", cloud->size(), radius, roughness);
  return roughness < 0.0025 ? 0 : 1;
}
