// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/filters/bilateral_normal_filter.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>

#include <functional>
#include <limits>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;

constexpr double kRadius = 0.12;

/** \brief A cube whose normals are off by about 10 degrees. */
Shape
cubeWithNoisyNormals(std::size_t count)
{
  Shape shape = cube(count);
  SplitMix64 random(9);
  for (Vector3& normal : shape.normals) {
    for (double& component : normal)
      component += 0.12 * random.normal();
    const double length = distance(normal, {0, 0, 0});
    for (double& component : normal)
      component /= length;
  }
  return shape;
}

Cloud
run(BilateralNormalFilter<PointT>& filter, const Cloud::Ptr& cloud)
{
  Cloud output;
  filter.setInputCloud(cloud);
  filter.filter(output);
  return output;
}

Cloud
runDefault(const Cloud::Ptr& cloud, double radius = kRadius)
{
  BilateralNormalFilter<PointT> filter;
  filter.setRadius(radius);
  filter.setAngle(30);
  return run(filter, cloud);
}

/** \brief Mean angle in radians to the exact normals of a cube. */
double
meanError(const Cloud& cloud)
{
  const Shape exact = cube(cloud.size());
  double sum = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3 n = normal(cloud[i]), e = exact.normals[i];
    sum += std::acos(std::fmin(1.0, std::fabs(n[0] * e[0] + n[1] * e[1] + n[2] * e[2])));
  }
  return sum / static_cast<double>(cloud.size());
}

TEST(BilateralNormalFilter, TakesNoiseOutOfNormalsAndKeepsEdges)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(5000));
  const double before = meanError(*cloud);
  EXPECT_LT(meanError(runDefault(cloud)), 0.35 * before);

  BilateralNormalFilter<PointT> by_neighbors;
  by_neighbors.setNeighbors(40);
  by_neighbors.setAngle(30);
  EXPECT_LT(meanError(run(by_neighbors, cloud)), 0.35 * before);
  EXPECT_FALSE(by_neighbors.getStatistics().radius_estimated);
  EXPECT_EQ(by_neighbors.getStatistics().radius, 0);

  BilateralNormalFilter<PointT> estimated;
  estimated.setAngle(30);
  EXPECT_LT(meanError(run(estimated, cloud)), 0.5 * before);
  EXPECT_TRUE(estimated.getStatistics().radius_estimated);
  EXPECT_GT(estimated.getStatistics().radius, 0.01);
  EXPECT_LT(estimated.getStatistics().radius, 0.3);
}

TEST(BilateralNormalFilter, PositionsKeepTheirBits)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(1000), 1, {1000, -2000, 1e-3});
  const Cloud output = runDefault(cloud);
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_EQ(output[i].x, (*cloud)[i].x);
    EXPECT_EQ(output[i].y, (*cloud)[i].y);
    EXPECT_EQ(output[i].z, (*cloud)[i].z);
  }
}

TEST(BilateralNormalFilter, SettersAndParametersAreOne)
{
  BilateralNormalsParameters p;
  p.radius = 0.5;
  p.angle = 20;
  p.iterations = 2;
  p.sign_invariant = false;
  p.number_of_threads = 3;
  BilateralNormalFilter<PointT> filter;
  filter.setParameters(p);
  EXPECT_EQ(filter.getRadius(), 0.5);
  EXPECT_EQ(filter.getNeighbors(), 0u);
  EXPECT_EQ(filter.getAngle(), 20);
  EXPECT_EQ(filter.getIterations(), 2u);
  EXPECT_FALSE(filter.getSignInvariant());
  EXPECT_EQ(filter.getNumberOfThreads(), 3u);
  BilateralNormalFilter<PointT> other;
  other.setRadius(0.5);
  other.setAngle(20);
  other.setIterations(2);
  other.setSignInvariant(false);
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(500));
  EXPECT_TRUE(sameBits(run(filter, cloud), run(other, cloud)));
  EXPECT_EQ(filter.getStatistics().normals.mean_change.size(), 2u);
}

TEST(BilateralNormalFilter, EveryParameterOutOfRangeThrows)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(BilateralNormalFilter<PointT>&)> mistakes[] = {
      [&](auto& f) { f.setRadius(nan); },
      [&](auto& f) { f.setRadius(-1); },
      [&](auto& f) { f.setNeighbors(2); },
      [&](auto& f) { f.setNeighbors(1001); },
      [&](auto& f) { f.setRadius(1); f.setNeighbors(10); },
      [&](auto& f) { f.setAngle(0); },
      [&](auto& f) { f.setAngle(91); },
      [&](auto& f) { f.setIterations(1001); }};
  for (const auto& mistake : mistakes) {
    BilateralNormalFilter<PointT> filter;
    mistake(filter);
    EXPECT_THROW(run(filter, toCloud<PointT>(cube(100))), pcl::BadArgumentException) << &mistake - mistakes;
  }
}

TEST(BilateralNormalFilter, ZeroIterationsOnlyNormalise)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(500));
  const Cloud expected = *cloud;
  for (PointT& point : *cloud)
    point.getNormalVector3fMap() *= 3;
  BilateralNormalFilter<PointT> filter;
  filter.setRadius(kRadius);
  filter.setIterations(0);
  EXPECT_LT(largestTurn(run(filter, cloud), expected), 1e-6);
}

TEST(BilateralNormalFilterLaws, EachNormalKeepsItsSignAndSignsDoNotMatter)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(3000));
  const Cloud::Ptr flipped(new Cloud(*cloud));
  for (std::size_t i = 0; i < flipped->size(); i += 1 + i % 3)
    (*flipped)[i].getNormalVector3fMap() *= -1;
  const Cloud output = runDefault(cloud);
  const Cloud output_flipped = runDefault(flipped);
  EXPECT_LT(largestTurn(output, output_flipped), 1e-5);
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_GT(output[i].getNormalVector3fMap().dot((*cloud)[i].getNormalVector3fMap()), 0);
    EXPECT_GT(output_flipped[i].getNormalVector3fMap().dot((*flipped)[i].getNormalVector3fMap()), 0);
  }
}

TEST(BilateralNormalFilterLaws, RigidMotionAndScaleCommute)
{
  const Shape shape = cubeWithNoisyNormals(2000);
  const Cloud expected = runDefault(toCloud<PointT>(shape));
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Eigen::Vector3d(3, 1, -2).normalized()).toRotationMatrix();
  Shape moved = shape;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    Eigen::Map<Eigen::Vector3d> point(moved.points[i].data()), normal(moved.normals[i].data());
    point = (rotation * point).eval();
    normal = (rotation * normal).eval();
  }
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Cloud output = runDefault(toCloud<PointT>(moved, scale, {3 * scale, -scale, 2 * scale}), scale * kRadius);
    for (std::size_t i = 0; i < output.size(); ++i) {
      const Eigen::Vector3d turned = rotation * expected[i].getNormalVector3fMap().cast<double>();
      EXPECT_LT((output[i].getNormalVector3fMap().cast<double>() - turned).norm(), 2e-5) << i << " at " << scale;
    }
  }
}

TEST(BilateralNormalFilter, RadiusThatExplodesIsRefusedBeforeTheWork)
{
  BilateralNormalFilter<PointT> filter;
  filter.setSignInvariant(false); // no means
  filter.setIterations(10);
  filter.setRadius(1000.0);
  bool begun = false;
  filter.setProgressCallback([&](double) { return begun = true; });
  EXPECT_THROW(run(filter, toCloud<PointT>(cube(100000))), pcl::ComputeFailedException);
  EXPECT_FALSE(begun);
}

TEST(BilateralNormalFilterLaws, PermutationCommutes)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cubeWithNoisyNormals(3000));
  const std::size_t count = cloud->size();
  const Cloud::Ptr permuted(new Cloud);
  for (std::size_t i = 0; i < count; ++i)
    permuted->push_back((*cloud)[(7 * i + 5) % count]);
  const Cloud expected = runDefault(cloud);
  const Cloud output = runDefault(permuted);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_LT(distance(normal(output[i]), normal(expected[(7 * i + 5) % count])), 1e-5) << i;
}

TEST(BilateralNormalFilterLaws, CleanShapesAndIsolatedPointsKeepTheirNormals)
{
  Shape shape = cubeWithNoisyNormals(1000);
  shape.points[500] = {5, 5, 5};
  const Cloud::Ptr cloud = toCloud<PointT>(shape);
  BilateralNormalFilter<PointT> filter;
  filter.setRadius(kRadius);
  const Cloud output = run(filter, cloud);
  EXPECT_LT(distance(normal(output[500]), normal((*cloud)[500])), 1e-6);
  EXPECT_GE(filter.getStatistics().normals.isolated_points, 1u);

  const Cloud::Ptr clean = toCloud<PointT>(cube(2000));
  EXPECT_LT(largestTurn(runDefault(clean), *clean), 1e-6) << "faces of a cube meet at more than sigma_n";
}

} // namespace
} // namespace pcl_gpf::test
