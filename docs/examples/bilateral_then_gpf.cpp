// SPDX-License-Identifier: BSD-3-Clause
// The whole chain on a cloud without normals: plane normals, bilateral normal filter, GPF.
#include <pcl_gpf/common/normal_estimation.h>
#include <pcl_gpf/filters/bilateral_normal_filter.h>
#include <pcl_gpf/filters/gpf.h>

#include <pcl/exceptions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/** \brief A noisy sample of the surface of the unit cube. */
static Cloud::Ptr
noisyCube(int count, float sigma)
{
  Cloud::Ptr cloud(new Cloud);
  std::mt19937 random;
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.0f, sigma);
  for (int i = 0; i < count; ++i) {
    std::array<float, 3> p = {uniform(random), uniform(random), uniform(random)};
    p[random() % 3] = static_cast<float>(random() % 2);
    pcl::PointNormal point;
    point.x = p[0] + noise(random);
    point.y = p[1] + noise(random);
    point.z = p[2] + noise(random);
    cloud->push_back(point);
  }
  return cloud;
}

/** \brief Mean distance of the points to the cube's nearest face plane. */
static double
meanError(const Cloud& cloud)
{
  double sum = 0;
  for (const pcl::PointNormal& p : cloud) {
    const auto toFaces = [](float c) { return std::min(std::abs(c), std::abs(c - 1)); };
    sum += std::min({toFaces(p.x), toFaces(p.y), toFaces(p.z)});
  }
  return sum / static_cast<double>(cloud.size());
}

int
main()
try {
  const Cloud::Ptr cloud = noisyCube(20000, 0.01f);
  const double before = meanError(*cloud);

  pcl_gpf::estimateNormals(*cloud);

  pcl_gpf::BilateralNormalFilter<pcl::PointNormal> bilateral;
  bilateral.setInputCloud(cloud);
  bilateral.filter(*cloud);

  pcl_gpf::GPF<pcl::PointNormal> gpf;
  gpf.setInputCloud(cloud);
  gpf.setProgressCallback([](double fraction) {
    std::printf("\rfilter %3.0f %%", 100 * fraction);
    return true; // false would cancel
  });
  gpf.filter(*cloud);

  std::printf("\nsupport radius %.3f%s\n", gpf.getStatistics().support_radius,
              gpf.getStatistics().support_radius_estimated ? " (estimated)" : "");
  for (const pcl_gpf::IterationStats& iteration : gpf.getStatistics().iterations)
    std::printf("mean movement %.5f\n", iteration.mean_movement);
  std::printf("mean error %.4f -> %.4f\n", before, meanError(*cloud));
  return meanError(*cloud) < 0.5 * before ? 0 : 1;
}
catch (const pcl::PCLException& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
