// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/surface/edge_aware_upsampling.h>

#include <pcl/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace pcl_gpf::test {
namespace {

template <typename PointT>
class EdgeAwareUpsamplingClass : public ::testing::Test {};

using PointTypes = ::testing::Types<pcl::PointNormal, pcl::PointXYZRGBNormal, pcl::PointXYZINormal>;
TYPED_TEST_SUITE(EdgeAwareUpsamplingClass, PointTypes);

TYPED_TEST(EdgeAwareUpsamplingClass, InputComesFirstUnchangedAndNewPointsCopyTheirParent)
{
  const auto cloud = toCloud<TypeParam>(cube(800, 0.002));
  cloud->header.frame_id = "scanner";
  cloud->header.stamp = 42;
  cloud->sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  EdgeAwareUpsampling<TypeParam> upsampling;
  upsampling.setInputCloud(cloud);
  upsampling.setFactor(2.5);
  pcl::PointCloud<TypeParam> output;
  upsampling.process(output);
  ASSERT_EQ(output.size(), 2000u);
  EXPECT_EQ(output.width, 2000u);
  EXPECT_EQ(output.height, 1u);
  EXPECT_TRUE(output.is_dense);
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_EQ(output.header.stamp, 42u);
  EXPECT_EQ(output.sensor_origin_, cloud->sensor_origin_);
  ASSERT_EQ(upsampling.getCorrespondingIndices().size(), output.size());
  for (std::size_t i = 0; i < output.size(); ++i) {
    const int parent = upsampling.getCorrespondingIndices()[i];
    EXPECT_EQ(numberOf(output[i]), parent) << "colour, intensity, curvature are those of one input point";
    if (i < cloud->size()) {
      EXPECT_EQ(parent, static_cast<int>(i));
      EXPECT_TRUE(sameBits(output[i], (*cloud)[i]));
    }
  }
  EXPECT_EQ(upsampling.getStatistics().inserted_points, 1200u);
  EXPECT_TRUE(upsampling.getStatistics().target_reached);
}

using Cloud = pcl::PointCloud<pcl::PointXYZRGBNormal>;

/** Two squares that meet at an edge, red and blue. */
Cloud::Ptr
twoColours()
{
  const Cloud::Ptr cloud = toCloud<pcl::PointXYZRGBNormal>(edge(3000, 0.001));
  for (pcl::PointXYZRGBNormal& point : *cloud)
    point.rgba = point.normal_z > 0.5f ? 0xffff0000u : 0xff0000ffu;
  return cloud;
}

TEST(EdgeAwareUpsamplingColour, IsNeverMixedAcrossAnEdge)
{
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  upsampling.setInputCloud(twoColours());
  upsampling.setFactor(4);
  Cloud output;
  upsampling.process(output);
  std::set<std::uint32_t> colours;
  for (const pcl::PointXYZRGBNormal& point : output) {
    colours.insert(point.rgba);
    EXPECT_EQ(point.rgba == 0xffff0000u, std::abs(point.normal_z) > 0.7f) << "the colour is that of the side of the normal";
  }
  EXPECT_EQ(colours, (std::set<std::uint32_t>{0xffff0000u, 0xff0000ffu}));
}

TEST(EdgeAwareUpsamplingContract, OutputMayBeTheInput)
{
  const Cloud::Ptr cloud = twoColours();
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  upsampling.setInputCloud(cloud);
  Cloud other;
  upsampling.process(other);
  upsampling.process(*cloud);
  EXPECT_TRUE(sameBits(other, *cloud));
}

TEST(EdgeAwareUpsamplingContract, IndicesChooseTheData)
{
  const Cloud::Ptr cloud = twoColours();
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 2999; i > 1000; i -= 2)
    indices->push_back(i);
  indices->push_back(2999); // twice
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  upsampling.setInputCloud(cloud);
  upsampling.setIndices(indices);
  upsampling.setFactor(2);
  Cloud output;
  upsampling.process(output);
  EXPECT_EQ(output.size(), 2000u);
  const std::set<int> allowed(indices->begin(), indices->end());
  for (const int index : upsampling.getCorrespondingIndices())
    EXPECT_EQ(allowed.count(index), 1u);
  EXPECT_TRUE(sameBits(output[0], (*cloud)[2999]));
  indices->push_back(3000);
  EXPECT_THROW(upsampling.process(output), pcl::BadArgumentException);
  EXPECT_TRUE(output.empty());
}

TEST(EdgeAwareUpsamplingContract, UnusablePoints)
{
  const Cloud::Ptr cloud = twoColours();
  (*cloud)[5].x = kNaN;
  (*cloud)[9].normal_x = (*cloud)[9].normal_y = (*cloud)[9].normal_z = 0;
  cloud->is_dense = false;
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  upsampling.setInputCloud(cloud);
  upsampling.setFactor(2);
  Cloud output;
  upsampling.process(output);
  EXPECT_EQ(output.size(), 2999u + 2998u) << "one point is left out, one stays without a child";
  EXPECT_FALSE(output.is_dense) << "a normal has no direction";
  EXPECT_EQ(upsampling.getStatistics().non_finite_points, 1u);
  EXPECT_EQ(upsampling.getStatistics().points_without_normal, 1u);
  for (const int index : upsampling.getCorrespondingIndices())
    EXPECT_NE(index, 5);
  for (pcl::PointXYZRGBNormal& point : *cloud)
    point.normal_x = point.normal_y = point.normal_z = kNaN;
  try {
    upsampling.process(output);
    FAIL();
  }
  catch (const pcl::BadArgumentException& error) {
    EXPECT_NE(std::string(error.what()).find("estimateNormals"), std::string::npos) << error.what();
  }
  for (pcl::PointXYZRGBNormal& point : *cloud)
    point.z = kNaN;
  upsampling.process(output);
  EXPECT_TRUE(output.empty());
}

TEST(EdgeAwareUpsamplingContract, NullAndTinyInput)
{
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  Cloud output = *twoColours();
  upsampling.process(output); // PCL's base crashes here
  EXPECT_TRUE(output.empty());
  upsampling.setInputCloud(Cloud::Ptr(new Cloud));
  upsampling.process(output);
  EXPECT_TRUE(output.empty());
  const Cloud::Ptr two(new Cloud(2, 1, (*twoColours())[0]));
  upsampling.setInputCloud(two);
  EXPECT_THROW(upsampling.process(output), pcl::ComputeFailedException);
  EXPECT_THROW(upsampling.process(*two), pcl::ComputeFailedException);
  EXPECT_EQ(two->size(), 2u) << "an in-place call that throws leaves the cloud as it was";
  upsampling.setInputCloud(twoColours());
  upsampling.setTargetCount(2999);
  EXPECT_THROW(upsampling.process(output), pcl::BadArgumentException);
  upsampling.setTargetCount(3001);
  upsampling.process(output);
  EXPECT_EQ(output.size(), 3001u) << "the object can be used again";
}

TEST(EdgeAwareUpsamplingContract, CancelAndThreads)
{
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  upsampling.setInputCloud(twoColours());
  upsampling.setFactor(4);
  upsampling.setProgressCallback([](double fraction) { return fraction < 0.1; });
  Cloud output;
  upsampling.process(output);
  EXPECT_TRUE(output.empty());
  EXPECT_TRUE(upsampling.getStatistics().cancelled);
  EXPECT_TRUE(upsampling.getCorrespondingIndices().empty());
  upsampling.setProgressCallback({});
  upsampling.setNumberOfThreads(1);
  upsampling.process(output);
  EXPECT_FALSE(upsampling.getStatistics().cancelled);
  Cloud threaded;
  upsampling.setNumberOfThreads(5);
  upsampling.process(threaded);
  EXPECT_TRUE(sameBits(output, threaded));
}

TEST(EdgeAwareUpsamplingContract, LengthsAreInCloudUnits)
{
  const Cloud::Ptr small = toCloud<pcl::PointXYZRGBNormal>(cube(1500)), large = toCloud<pcl::PointXYZRGBNormal>(cube(1500), 256);
  EdgeAwareUpsampling<pcl::PointXYZRGBNormal> upsampling;
  Cloud output, scaled;
  upsampling.setInputCloud(small);
  upsampling.setRadius(0.15);
  upsampling.setSpacing(0.04);
  upsampling.process(output);
  EXPECT_NEAR(upsampling.getStatistics().radius, 0.15, 1e-9);
  upsampling.setInputCloud(large);
  upsampling.setRadius(0.15 * 256);
  upsampling.setSpacing(0.04 * 256);
  upsampling.process(scaled);
  ASSERT_EQ(output.size(), scaled.size());
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_LT(distance(position(scaled[i]), {256.0 * output[i].x, 256.0 * output[i].y, 256.0 * output[i].z}), 256 * 1e-6);
}

} // namespace
} // namespace pcl_gpf::test
