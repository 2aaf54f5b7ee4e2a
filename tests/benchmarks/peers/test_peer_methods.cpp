// SPDX-License-Identifier: BSD-3-Clause
#include "peer_methods.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace {

using namespace pcl_gpf::benchmark_peers;

constexpr std::size_t kCount = 3000;
constexpr double kNoise = 0.01;
constexpr double kOffset = 1e4; // of a cloud far from the origin

/** A noisy unit square at z = kOffset. */
PeerCloud
square(bool normals)
{
  PeerCloud cloud;
  for (const pcl_gpf::test::Vector3& p : pcl_gpf::test::plane(kCount, kNoise).points) {
    cloud.x.push_back(p[0]);
    cloud.y.push_back(p[1]);
    cloud.z.push_back(p[2] + kOffset);
  }
  if (normals) {
    cloud.normal_x.assign(kCount, 0.0);
    cloud.normal_y.assign(kCount, 0.0);
    cloud.normal_z.assign(kCount, 1.0);
  }
  return cloud;
}

double
meanHeight(const PeerCloud& cloud)
{
  double sum = 0;
  for (const double z : cloud.z)
    sum += std::abs(z - kOffset);
  return sum / static_cast<double>(cloud.size());
}

double
meanTilt(const PeerCloud& cloud)
{
  double sum = 0;
  for (const double z : cloud.normal_z)
    sum += 1 - std::abs(z);
  return sum / static_cast<double>(cloud.size());
}

void
expectSame(const std::function<PeerCloud(unsigned threads)>& method)
{
  const PeerCloud one = method(1), two = method(2);
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
  EXPECT_EQ(one.z, two.z);
  EXPECT_EQ(one.normal_x, two.normal_x);
}

double
inputHeight()
{
  return meanHeight(square(false));
}

TEST(PeerMethods, PclNormalsStandOnThePlaneAndFaceTheOrigin)
{
  PeerCloud cloud = square(false);
  estimateNormalsPcl(cloud, 100, 2);
  EXPECT_LT(meanTilt(cloud), 0.02);
  EXPECT_LT(*std::max_element(cloud.normal_z.begin(), cloud.normal_z.end()), 0.0);
  expectSame([](unsigned threads) {
    PeerCloud made = square(false);
    estimateNormalsPcl(made, 30, threads);
    return made;
  });
}

TEST(PeerMethods, MovingLeastSquaresSmoothsInInputOrder)
{
  PeerCloud cloud = square(false);
  cloud.x[7] += 50; // without neighbours
  const PclMlsResult result = pclMovingLeastSquares(cloud, 0.1, 2);
  ASSERT_EQ(result.cloud.size(), kCount - 1);
  ASSERT_EQ(result.sources.size(), kCount - 1);
  for (std::size_t i = 0; i < result.sources.size(); ++i)
    EXPECT_EQ(result.sources[i], i < 7 ? i : i + 1);
  EXPECT_LT(meanHeight(result.cloud), 0.4 * inputHeight());
  EXPECT_LT(meanTilt(result.cloud), 0.02);
  expectSame([](unsigned threads) { return pclMovingLeastSquares(square(false), 0.1, threads).cloud; });
}

TEST(PeerMethods, WlopHalvesAndSmooths)
{
  CgalWlopParameters parameters;
  parameters.radius = 0.15;
  parameters.retain_percent = 50;
  const PeerCloud result = cgalWlop(square(false), parameters, 2);
  EXPECT_EQ(result.size(), kCount / 2);
  EXPECT_FALSE(result.hasNormals());
  EXPECT_LT(meanHeight(result), 0.5 * inputHeight());
  parameters.radius = 0; // CGAL's choice
  parameters.iterations = 2;
  expectSame([&](unsigned threads) { return cgalWlop(square(false), parameters, threads); });
}

TEST(PeerMethods, BilateralSmoothingSmooths)
{
  PeerCloud cloud = square(true);
  cgalBilateralSmooth(cloud, {}, 2);
  EXPECT_LT(meanHeight(cloud), 0.4 * inputHeight());
  const PeerCloud input = square(true);
  double along = 0;
  for (std::size_t i = 0; i < kCount; ++i)
    along += std::abs(cloud.x[i] - input.x[i]) / static_cast<double>(kCount);
  EXPECT_LT(along, 0.1 * inputHeight()) << "rows are in order and move along the normals";
  expectSame([](unsigned threads) {
    PeerCloud made = square(true);
    cgalBilateralSmooth(made, {30, 25, 1}, threads);
    return made;
  });
}

TEST(PeerMethods, JetSmoothingSmooths)
{
  PeerCloud cloud = square(false);
  cgalJetSmooth(cloud, 48, 1, 2);
  EXPECT_LT(meanHeight(cloud), 0.5 * inputHeight());
  expectSame([](unsigned threads) {
    PeerCloud made = square(false);
    cgalJetSmooth(made, 24, 2, threads);
    return made;
  });
}

TEST(PeerMethods, CgalNormalsStandOnThePlaneAndAreOriented)
{
  PeerCloud cloud = square(false);
  cgalPcaNormals(cloud, 100, 2);
  EXPECT_LT(meanTilt(cloud), 0.02);
  for (std::size_t i = 0; i < kCount; i += 2)
    cloud.normal_z[i] *= -1, cloud.normal_y[i] *= -1, cloud.normal_x[i] *= -1;
  EXPECT_EQ(cgalMstOrientNormals(cloud, 18), 0u);
  const double first = cloud.normal_z.front();
  EXPECT_TRUE(std::all_of(cloud.normal_z.begin(), cloud.normal_z.end(), [&](double z) { return z * first > 0; }));
}

TEST(PeerMethods, ParametersOutOfRangeAreRefused)
{
  PeerCloud none, cloud = square(false);
  EXPECT_THROW(estimateNormalsPcl(none, 3, 1), std::invalid_argument);
  EXPECT_THROW(estimateNormalsPcl(cloud, kCount + 1, 1), std::invalid_argument);
  EXPECT_THROW(estimateNormalsPcl(cloud, 30, 0), std::invalid_argument);
  EXPECT_THROW(pclMovingLeastSquares(cloud, 0.0, 1), std::invalid_argument);
  EXPECT_THROW(pclMovingLeastSquares(none, 1.0, 1), std::invalid_argument);
  EXPECT_THROW(cgalWlop(none, {}, 1), std::invalid_argument);
  EXPECT_THROW(cgalWlop(cloud, {0.1, 0, 50, false}, 1), std::invalid_argument);
  EXPECT_THROW(cgalBilateralSmooth(cloud, {}, 1), std::invalid_argument) << "it has no normals";
  EXPECT_THROW(cgalJetSmooth(cloud, 5, 1, 1), std::invalid_argument);
  EXPECT_THROW(cgalMstOrientNormals(cloud, 18), std::invalid_argument);
}

} // namespace
