// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/filters/normal_orientation.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>

#include <functional>
#include <limits>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;

/** \brief A cloud with exact normals, every third of which is turned round. */
Cloud::Ptr
mixedSigns(const Shape& shape, double scale = 1, const Vector3& offset = {0, 0, 0})
{
  const Cloud::Ptr cloud = toCloud<PointT>(shape, scale, offset);
  for (std::size_t i = 0; i < cloud->size(); i += 3)
    (*cloud)[i].getNormalVector3fMap() *= -1;
  return cloud;
}

Cloud
run(NormalOrientation<PointT>& filter, const Cloud::Ptr& cloud)
{
  Cloud output;
  filter.setInputCloud(cloud);
  filter.filter(output);
  return output;
}

std::size_t
countWrong(const Cloud& cloud, const Shape& shape)
{
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3 n = normal(cloud[i]), e = shape.normals[i];
    wrong += n[0] * e[0] + n[1] * e[1] + n[2] * e[2] < 0;
  }
  return wrong;
}

TEST(NormalOrientationFilter, TurnsClosedSurfacesOutwardAnywhereAndInAnyUnit)
{
  const Shape shape = sphere(3000, 0.005);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    NormalOrientation<PointT> filter;
    filter.setNoise(0.005 * scale);
    const Cloud output = run(filter, mixedSigns(shape, scale, {100 * scale, -50 * scale, 0}));
    EXPECT_EQ(countWrong(output, shape), 0u) << scale;
    EXPECT_EQ(filter.getStatistics().orientation.flipped, 1000u);
    EXPECT_EQ(filter.getStatistics().orientation.parts_outward, 1u);
    EXPECT_NEAR(filter.getStatistics().orientation.noise, 0.005 * scale, 1e-9 * scale);
  }
}

TEST(NormalOrientationFilter, PositionsKeepTheirBits)
{
  const Cloud::Ptr cloud = mixedSigns(cube(1000, 0.01), 1, {1000, -2000, 1e-3});
  NormalOrientation<PointT> filter;
  const Cloud output = run(filter, cloud);
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_EQ(output[i].x, (*cloud)[i].x);
    EXPECT_EQ(output[i].y, (*cloud)[i].y);
    EXPECT_EQ(output[i].z, (*cloud)[i].z);
  }
}

TEST(NormalOrientationFilter, ViewPointGivenOrOfTheSensorOrNone)
{
  const Shape square = plane(1000);
  const Cloud::Ptr cloud = mixedSigns(square, 1, {10, 20, 30});
  cloud->sensor_origin_ = Eigen::Vector4f(10, 20, -70, 0);
  NormalOrientation<PointT> filter;
  EXPECT_FALSE(filter.hasViewPoint());
  EXPECT_EQ(countWrong(run(filter, cloud), square), 0u) << "the highest point looks up";
  EXPECT_EQ(filter.getStatistics().orientation.parts_by_root, 1u);
  filter.useSensorOriginAsViewPoint();
  EXPECT_TRUE(filter.hasViewPoint());
  EXPECT_EQ(countWrong(run(filter, cloud), square), 1000u) << "the sensor is below";
  EXPECT_EQ(filter.getStatistics().orientation.parts_by_viewpoint, 1u);
  filter.setViewPoint(10, 20, 31);
  EXPECT_EQ(countWrong(run(filter, cloud), square), 0u);
  filter.clearViewPoint();
  EXPECT_FALSE(filter.hasViewPoint());
}

TEST(NormalOrientationFilter, SettersAndParametersAreOne)
{
  NormalOrientationParameters p;
  p.neighbors = 9;
  p.noise = 0.02;
  p.gap = 3;
  p.number_of_threads = 2;
  NormalOrientation<PointT> filter;
  filter.setParameters(p);
  EXPECT_EQ(filter.getNeighbors(), 9u);
  EXPECT_EQ(filter.getNoise(), 0.02);
  EXPECT_EQ(filter.getGap(), 3);
  EXPECT_EQ(filter.getNumberOfThreads(), 2u);
  const Cloud::Ptr cloud = mixedSigns(cube(1000, 0.01));
  run(filter, cloud);
  EXPECT_EQ(filter.getStatistics().orientation.votes, 9000u);
  EXPECT_NEAR(filter.getStatistics().orientation.noise, 0.02, 1e-12);
}

TEST(NormalOrientationFilter, EveryParameterOutOfRangeThrows)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(NormalOrientation<PointT>&)> mistakes[] = {
      [](auto& f) { f.setNeighbors(2); }, [](auto& f) { f.setNeighbors(101); },
      [](auto& f) { f.setNoise(-1); },    [&](auto& f) { f.setNoise(nan); },
      [](auto& f) { f.setGap(101); },     [&](auto& f) { f.setViewPoint(nan, 0, 0); }};
  for (const auto& mistake : mistakes) {
    NormalOrientation<PointT> filter;
    mistake(filter);
    EXPECT_THROW(run(filter, mixedSigns(cube(100))), pcl::BadArgumentException) << &mistake - mistakes;
  }
  const Cloud::Ptr cloud = mixedSigns(cube(100));
  cloud->sensor_origin_[2] = std::numeric_limits<float>::infinity();
  NormalOrientation<PointT> filter;
  run(filter, cloud); // without a view point the pose does not matter
  filter.useSensorOriginAsViewPoint();
  EXPECT_THROW(run(filter, cloud), pcl::BadArgumentException);
}

} // namespace
} // namespace pcl_gpf::test
