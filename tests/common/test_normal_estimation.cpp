// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/common/normal_estimation.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointXYZRGBNormal;
using Cloud = pcl::PointCloud<PointT>;

Cloud::Ptr
sphereWithoutNormals(std::size_t count, const Vector3& offset = {0, 0, 0})
{
  const Cloud::Ptr cloud = toCloud<PointT>(sphere(count), 1, offset);
  for (PointT& point : *cloud)
    point.getNormalVector3fMap().setZero();
  return cloud;
}

TEST(NormalEstimation, FillsNormalsIntoTheSameCloudAndNothingElse)
{
  const Cloud::Ptr cloud = sphereWithoutNormals(2000);
  cloud->width = 50;
  cloud->height = 40;
  cloud->sensor_origin_ = Eigen::Vector4f(0, 0, 9, 0);
  const Cloud before = *cloud;
  EXPECT_EQ(estimateNormals(*cloud), 0u);
  EXPECT_TRUE(cloud->is_dense);
  EXPECT_EQ(cloud->height, 40u);
  const Shape exact = sphere(2000);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const PointT& point = (*cloud)[i];
    EXPECT_EQ(position(point), position(before[i]));
    EXPECT_EQ(point.rgba, before[i].rgba);
    const Vector3 n = normal(point), e = exact.normals[i];
    EXPECT_GT(std::fabs(n[0] * e[0] + n[1] * e[1] + n[2] * e[2]), 0.97);
    const Eigen::Vector3f to_sensor = Eigen::Vector3f(0, 0, 9) - point.getVector3fMap();
    EXPECT_GE(point.getNormalVector3fMap().dot(to_sensor), -1e-4f) << "towards the sensor";
    EXPECT_GE(point.curvature, 0);
    EXPECT_LT(point.curvature, 0.1);
  }
}

TEST(NormalEstimation, NonFinitePointsGetNoNormalEvenWhenTheCloudClaimsToBeDense)
{
  const Cloud::Ptr cloud = sphereWithoutNormals(500);
  (*cloud)[0].x = kNaN;
  (*cloud)[77].z = std::numeric_limits<float>::infinity();
  cloud->is_dense = true;
  EXPECT_EQ(estimateNormals(*cloud), 2u);
  EXPECT_FALSE(cloud->is_dense);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    EXPECT_EQ(pcl::isNormalFinite((*cloud)[i]), i != 0 && i != 77);
}

TEST(NormalEstimation, ByRadiusLonelyPointsGetNoNormal)
{
  const Cloud::Ptr cloud = sphereWithoutNormals(1000);
  (*cloud)[5].x = 100;
  NormalEstimationParameters parameters;
  parameters.radius = 0.15;
  EXPECT_EQ(estimateNormals(*cloud, parameters), 1u);
  EXPECT_TRUE(std::isnan((*cloud)[5].normal_x));
  EXPECT_EQ((*cloud)[5].x, 100.0f);
}

TEST(NormalEstimation, LargeCoordinatesAndThreadsDoNotMatter)
{
  const Cloud::Ptr near = sphereWithoutNormals(1000);
  const Cloud::Ptr far = sphereWithoutNormals(1000, {1024, -2048, 512});
  far->sensor_origin_ = Eigen::Vector4f(1024, -2048, 512, 0);
  NormalEstimationParameters parameters;
  parameters.number_of_threads = 3;
  estimateNormals(*near);
  estimateNormals(*far, parameters);
  double sum = 0;
  for (std::size_t i = 0; i < near->size(); ++i)
    sum += std::fmin(distance(normal((*near)[i]), normal((*far)[i])), 2.0);
  EXPECT_LT(sum / 1000, 0.02) << "positions are quantised to 1e-4 there";
}

TEST(NormalEstimation, EmptyTinyAndAllNaNClouds)
{
  Cloud cloud;
  EXPECT_EQ(estimateNormals(cloud), 0u);
  EXPECT_TRUE(cloud.is_dense);
  for (const std::size_t count : {1u, 2u}) {
    cloud = *sphereWithoutNormals(count);
    EXPECT_EQ(estimateNormals(cloud), count) << "no plane";
    EXPECT_FALSE(cloud.is_dense);
  }
  cloud = *sphereWithoutNormals(10);
  for (PointT& point : cloud)
    point.x = kNaN;
  EXPECT_EQ(estimateNormals(cloud), 10u);
}

TEST(NormalEstimation, NeighboursBeyondTheCloudAreAllOfIt)
{
  const Cloud::Ptr all = sphereWithoutNormals(60), more = sphereWithoutNormals(60);
  NormalEstimationParameters parameters;
  parameters.neighbors = 60;
  estimateNormals(*all, parameters);
  parameters.neighbors = std::numeric_limits<unsigned>::max(); // -1 as PCL counts
  EXPECT_EQ(estimateNormals(*more, parameters), 0u);
  for (std::size_t i = 0; i < all->size(); ++i)
    EXPECT_EQ(normal((*more)[i]), normal((*all)[i]));
}

TEST(NormalEstimation, PointsFartherApartThanFloatReachesGetNoNormal)
{
  const Cloud::Ptr cloud = sphereWithoutNormals(200);
  (*cloud)[0].x = -3e38f; // garbage, and the first point at that: its difference from the second is infinite
  (*cloud)[9].x = 3e38f;
  EXPECT_EQ(estimateNormals(*cloud), 2u);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    EXPECT_EQ(pcl::isNormalFinite((*cloud)[i]), i != 0 && i != 9) << i;
}

TEST(NormalEstimation, ParametersOutOfRangeThrow)
{
  const Cloud::Ptr cloud = sphereWithoutNormals(100);
  NormalEstimationParameters few;
  few.neighbors = 2;
  EXPECT_THROW(estimateNormals(*cloud, few), pcl::BadArgumentException);
  using Limits = std::numeric_limits<double>;
  for (const double radius : {-1.0, Limits::quiet_NaN(), Limits::infinity()}) {
    NormalEstimationParameters parameters;
    parameters.radius = radius;
    EXPECT_THROW(estimateNormals(*cloud, parameters), pcl::BadArgumentException);
  }
}

} // namespace
} // namespace pcl_gpf::test
