// SPDX-License-Identifier: BSD-3-Clause
// Each test is one of the traps of pcl::MovingLeastSquares that MLSUpsampling closes.
#include "support/clouds.h"

#include <pcl_gpf/surface/mls_upsampling.h>

#include <pcl/exceptions.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl_gpf::test {
namespace {

using Point = pcl::PointXYZRGBNormal;
using Cloud = pcl::PointCloud<Point>;
using Mls = MLSUpsampling<Point>;

constexpr MLSMethod kMethods[] = {MLSMethod::None, MLSMethod::SampleLocalPlane, MLSMethod::RandomUniformDensity,
                                  MLSMethod::VoxelGridDilation};

Cloud
run(Mls& mls, const Cloud::Ptr& cloud, MLSMethod method, unsigned threads = 0)
{
  mls.setInputCloud(cloud);
  mls.setMethod(method);
  mls.setNumberOfThreads(threads);
  Cloud output;
  mls.process(output);
  return output;
}

Cloud::Ptr
ball(std::size_t count = 3000, double noise = 0.002)
{
  return toCloud<Point>(sphere(count, noise));
}

TEST(MLSUpsampling, SameOrderAndBitsInEveryRunAndForAnyNumberOfThreads)
{
  const Cloud::Ptr cloud = ball();
  for (const MLSMethod method : kMethods) {
    Mls first, second, threaded;
    const Cloud once = run(first, cloud, method, 1);
    EXPECT_FALSE(once.empty());
    EXPECT_TRUE(sameBits(once, run(second, cloud, method, 1)));
    EXPECT_TRUE(sameBits(once, run(threaded, cloud, method, 4)));
    EXPECT_EQ(first.getCorrespondingIndices(), threaded.getCorrespondingIndices());
    EXPECT_TRUE(std::is_sorted(first.getCorrespondingIndices().begin(), first.getCorrespondingIndices().end()));
  }
}

TEST(MLSUpsampling, RandomModeTakesASeedAndMakesAboutTwiceAsMany)
{
  const Cloud::Ptr cloud = ball();
  Mls mls;
  mls.setSeed(7);
  const Cloud seven = run(mls, cloud, MLSMethod::RandomUniformDensity);
  mls.setSeed(8);
  const Cloud eight = run(mls, cloud, MLSMethod::RandomUniformDensity);
  EXPECT_FALSE(sameBits(seven, eight));
  EXPECT_NEAR(static_cast<double>(seven.size()), 6000, 900);
}

TEST(MLSUpsampling, PoseHeaderFieldsAndDensityOfInputAreKept)
{
  const Cloud::Ptr cloud = ball();
  cloud->header.frame_id = "scanner";
  cloud->sensor_origin_ = Eigen::Vector4f(4, 5, 6, 0);
  cloud->sensor_orientation_ = Eigen::Quaternionf(0, 1, 0, 0);
  for (const MLSMethod method : kMethods) {
    Mls mls;
    const Cloud output = run(mls, cloud, method);
    EXPECT_EQ(output.header.frame_id, "scanner");
    EXPECT_EQ(output.sensor_origin_, cloud->sensor_origin_);
    EXPECT_EQ(output.sensor_orientation_.coeffs(), cloud->sensor_orientation_.coeffs());
    EXPECT_TRUE(output.is_dense);
    EXPECT_EQ(output.height, 1u);
    EXPECT_EQ(output.width, output.size());
    ASSERT_EQ(mls.getCorrespondingIndices().size(), output.size());
    for (std::size_t i = 0; i < output.size(); ++i)
      EXPECT_EQ(output[i].rgba, (*cloud)[static_cast<std::size_t>(mls.getCorrespondingIndices()[i])].rgba);
  }
}

TEST(MLSUpsampling, PointsLieOnTheSurfaceWithNormalsOfTheInputsSide)
{
  const Cloud::Ptr cloud = ball(3000, 0.0);
  for (const double inward : {1.0, -1.0}) {
    for (Point& point : *cloud)
      point.getNormalVector3fMap() = static_cast<float>(inward) * point.getVector3fMap().normalized();
    for (const MLSMethod method : kMethods) {
      Mls mls;
      for (const Point& point : run(mls, cloud, method)) {
        EXPECT_NEAR(point.getVector3fMap().norm(), 0.5f, 0.01f);
        EXPECT_NEAR(point.getNormalVector3fMap().norm(), 1.0f, 1e-5f);
        EXPECT_GT(inward * static_cast<double>(point.getNormalVector3fMap().dot(point.getVector3fMap().normalized())), 0.9);
      }
    }
  }
}

TEST(MLSUpsampling, WithoutNormalsTheViewpointOrients)
{
  const Cloud::Ptr cloud = toCloud<Point>(plane(1000));
  for (Point& point : *cloud)
    point.normal_x = point.normal_y = point.normal_z = kNaN;
  for (const float side : {5.0f, -5.0f}) {
    cloud->sensor_origin_ = Eigen::Vector4f(0, 0, side, 0);
    Mls mls;
    for (const Point& point : run(mls, cloud, MLSMethod::None))
      EXPECT_GT(point.normal_z * side, 0.0f);
  }
}

TEST(MLSUpsampling, DroppedPointsAreTold)
{
  const Cloud::Ptr cloud = ball(1000, 0.0);
  Point lonely = (*cloud)[0];
  lonely.x = 40;
  cloud->insert(cloud->begin() + 3, lonely);
  Mls mls;
  mls.setSearchRadius(0.2);
  const Cloud output = run(mls, cloud, MLSMethod::None);
  EXPECT_EQ(output.size(), 1000u);
  EXPECT_EQ(mls.getDroppedIndices(), pcl::Indices{3});
  EXPECT_EQ(mls.getCorrespondingIndices()[3], 4);
}

TEST(MLSUpsampling, NullEmptyTinyAndNonFiniteInput)
{
  Mls mls;
  Cloud output = *ball(10);
  mls.process(output); // PCL crashes here
  EXPECT_TRUE(output.empty());
  EXPECT_TRUE(run(mls, Cloud::Ptr(new Cloud), MLSMethod::None).empty());
  EXPECT_THROW(run(mls, Cloud::Ptr(new Cloud(2, 1, (*ball())[0])), MLSMethod::None), pcl::ComputeFailedException);
  EXPECT_THROW(run(mls, Cloud::Ptr(new Cloud(50, 1, (*ball())[0])), MLSMethod::None), pcl::ComputeFailedException);
  const Cloud::Ptr holes = ball(500);
  (*holes)[7].y = kNaN;
  holes->is_dense = false;
  const Cloud filled = run(mls, holes, MLSMethod::VoxelGridDilation);
  EXPECT_TRUE(filled.is_dense);
  EXPECT_EQ(mls.getStatistics().non_finite_points, 1u);
  for (const int index : mls.getCorrespondingIndices())
    EXPECT_NE(index, 7);
}

TEST(MLSUpsampling, OutputMayBeTheInputAndIndicesChooseTheData)
{
  const Cloud::Ptr cloud = ball(1000);
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 0; i < 500; ++i)
    indices->push_back(2 * i);
  Mls mls;
  mls.setIndices(indices);
  const Cloud half = run(mls, cloud, MLSMethod::None);
  EXPECT_EQ(half.size(), 500u);
  for (const int index : mls.getCorrespondingIndices())
    EXPECT_EQ(index % 2, 0);
  mls.process(*cloud);
  EXPECT_TRUE(sameBits(half, *cloud));
}

TEST(MLSUpsampling, FarFromTheOriginItIsAsGood)
{
  // 2^-10 is a step of floats at 2^13, so that both clouds hold the same numbers.
  Shape shape = sphere(2000, 0.0);
  for (Vector3& p : shape.points)
    for (double& c : p)
      c = std::round(c * 64 * 1024) / 1024;
  Mls mls;
  const Cloud near = run(mls, toCloud<Point>(shape), MLSMethod::None);
  const Cloud far = run(mls, toCloud<Point>(shape, 1, {8192, 8192, 8192}), MLSMethod::None);
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    EXPECT_LT(distance(position(far[i]), {near[i].x + 8192.0, near[i].y + 8192.0, near[i].z + 8192.0}), 2e-3);
}

TEST(MLSUpsampling, LengthsThatFloatCannotSquareAreRefused)
{
  for (const float unit : {1e25f, 1e-30f}) { // PCL divides by a voxel count of 0, or drops every point
    const Cloud::Ptr cloud = ball(500);
    for (Point& p : *cloud)
      p.getVector3fMap() *= unit;
    Mls mls;
    EXPECT_THROW(run(mls, cloud, MLSMethod::VoxelGridDilation), pcl::ComputeFailedException) << unit;
    EXPECT_THROW(run(mls, cloud, MLSMethod::RandomUniformDensity), pcl::ComputeFailedException) << unit;
  }
}

TEST(MLSUpsampling, ParametersAndWorkAreCheckedBefore)
{
  const Cloud::Ptr cloud = ball(1000);
  const auto fails = [&](auto change) {
    MLSUpsamplingParameters p;
    change(p);
    Mls mls;
    mls.setInputCloud(cloud);
    mls.setParameters(p);
    Cloud output;
    mls.process(output);
  };
  EXPECT_THROW(fails([](auto& p) { p.radius = -1; }), pcl::BadArgumentException);
  EXPECT_THROW(fails([](auto& p) { p.radius = std::numeric_limits<double>::quiet_NaN(); }), pcl::BadArgumentException);
  EXPECT_THROW(fails([](auto& p) { p.order = 6; }), pcl::BadArgumentException);
  EXPECT_THROW(fails([](auto& p) { p.dilation_iterations = 17; }), pcl::BadArgumentException);
  EXPECT_THROW(fails([](auto& p) { p.voxel_size = 1e-9; }), pcl::ComputeFailedException);
  EXPECT_THROW(fails([](auto& p) { p.method = MLSMethod::SampleLocalPlane, p.upsampling_step = 1e-6; }), pcl::ComputeFailedException);
  EXPECT_THROW(fails([](auto& p) { p.method = MLSMethod::RandomUniformDensity, p.density = 1e9; }), pcl::ComputeFailedException);
}

TEST(MLSUpsampling, ARadiusOfEverythingIsRefusedBeforeTheWork)
{
  const Cloud::Ptr cloud = ball(40000); // PCL would find 1.6 billion neighbours
  Mls mls;
  mls.setSearchRadius(10);
  EXPECT_THROW(run(mls, cloud, MLSMethod::None), pcl::ComputeFailedException);
  mls.setSearchRadius(0.05);
  EXPECT_EQ(run(mls, cloud, MLSMethod::None).size(), cloud->size());
}

} // namespace
} // namespace pcl_gpf::test
