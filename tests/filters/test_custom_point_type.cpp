// SPDX-License-Identifier: BSD-3-Clause
// A point type that the library was not compiled for.
#define PCL_NO_PRECOMPILE
#include <pcl_gpf/common/normal_estimation.h>
#include <pcl_gpf/filters/bilateral_normal_filter.h>
#include <pcl_gpf/filters/gpf.h>

#include "filters/scanner_point.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

TEST(CustomPointType, GoesThroughTheWholeChain)
{
  const Shape shape = plane(1000, 0.01);
  const pcl::PointCloud<ScannerPoint>::Ptr cloud(new pcl::PointCloud<ScannerPoint>);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    ScannerPoint point;
    point.x = static_cast<float>(shape.points[i][0]);
    point.y = static_cast<float>(shape.points[i][1]);
    point.z = static_cast<float>(shape.points[i][2]);
    point.time = 0.1 * static_cast<double>(i);
    point.ring = static_cast<std::uint16_t>(i % 64);
    cloud->push_back(point);
  }
  EXPECT_EQ(estimateNormals(*cloud), 0u);

  BilateralNormalFilter<ScannerPoint> bilateral;
  bilateral.setRadius(0.1);
  bilateral.setAngle(30);
  bilateral.setInputCloud(cloud);
  bilateral.filter(*cloud);

  GPF<ScannerPoint> gpf;
  gpf.setSupportRadius(0.2);
  gpf.setInputCloud(cloud);
  pcl::PointCloud<ScannerPoint> output;
  gpf.filter(output);

  ASSERT_EQ(output.size(), cloud->size());
  double before = 0, after = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_EQ(output[i].time, 0.1 * static_cast<double>(i));
    EXPECT_EQ(output[i].ring, i % 64);
    before += std::abs(shape.points[i][2]);
    after += std::abs(output[i].z);
  }
  EXPECT_LT(after, 0.6 * before);
}

} // namespace
} // namespace pcl_gpf::test
