// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/common/unpack.h>

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <string>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointXYZINormal;
using Cloud = pcl::PointCloud<PointT>;

pcl::Indices
everyIndex(const Cloud& cloud)
{
  pcl::Indices indices(cloud.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TEST(Pack, FrameHasItsBoxCentredAndOfDiagonalOne)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(1000), 7, {500000, -3, 20});
  const PackedCloud packed = pack(*cloud, everyIndex(*cloud));
  ASSERT_EQ(packed.size(), 1000u);
  BoundingBox box;
  for (std::size_t i = 0; i < packed.size(); ++i)
    box.add(packed.points.x[i], packed.points.y[i], packed.points.z[i]);
  EXPECT_NEAR(box.diagonal(), 1, 1e-6);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(box.min[axis] + box.max[axis], 0, 1e-6);
  EXPECT_FALSE(packed.all_identical);
}

TEST(Pack, RefusesAPointBesideWhichNothingCanBeToldApart)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(1000));
  for (const float far : {1e16f, 1e30f, std::numeric_limits<float>::max()}) {
    (*cloud)[77].y = far;
    try {
      pack(*cloud, everyIndex(*cloud));
      ADD_FAILURE() << far;
    } catch (const UnsuitableData& error) {
      EXPECT_NE(std::string(error.what()).find("point 77 "), std::string::npos) << error.what();
    }
  }
  pcl::Indices others = everyIndex(*cloud);
  others.erase(others.begin() + 77);
  EXPECT_EQ(pack(*cloud, others).size(), 999u);
  (*cloud)[77].y = 1e12f; // an outlier, no more
  EXPECT_EQ(pack(*cloud, everyIndex(*cloud)).size(), 1000u);
}

TEST(Pack, PositionAndRemainderGiveTheCloudBack)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(100), 3, {1e6, 0.1, -5});
  const PackedCloud packed = pack(*cloud, everyIndex(*cloud));
  const SoaBuffer remainders = packRemainders(*cloud, packed);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const double local = static_cast<double>(packed.points.x[i]) + remainders.x[i];
    EXPECT_NEAR(local * packed.frame.scale + packed.frame.origin[0], (*cloud)[i].x, 1e-9 * packed.frame.scale);
    EXPECT_LE(std::fabs(remainders.x[i]), 3.1e-8f);
  }
}

TEST(Pack, SortsPointsOutAndTakesEachOnce)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(10));
  (*cloud)[2].z = kNaN;
  (*cloud)[4].x = -std::numeric_limits<float>::infinity();
  (*cloud)[5].getNormalVector3fMap().setZero();
  (*cloud)[6].normal_y = kNaN;
  (*cloud)[7].normal_x = std::numeric_limits<float>::infinity();
  (*cloud)[8].getNormalVector3fMap() *= 3e38f; // overflows when squared in float
  const PackedCloud packed = pack(*cloud, {9, 8, 7, 6, 5, 4, 2, 9, 4, 0});
  EXPECT_EQ(packed.chosen, (pcl::Indices{9, 8, 7, 6, 5, 4, 2, 0}));
  using S = PointState;
  EXPECT_EQ(packed.states,
            (std::vector<S>{S::Usable, S::Usable, S::WithoutNormal, S::WithoutNormal, S::WithoutNormal,
                            S::NonFinite, S::NonFinite, S::Usable}));
  EXPECT_EQ(packed.size(), 3u);
  EXPECT_EQ(packed.points_without_normal, 3u);
  EXPECT_EQ(packed.non_finite_points, 2u);
  for (std::size_t i = 0; i < packed.size(); ++i)
    EXPECT_NEAR(std::hypot(packed.normals.x[i], packed.normals.y[i], packed.normals.z[i]), 1, 1e-6);
}

TEST(Pack, DegenerateClouds)
{
  Cloud cloud;
  EXPECT_EQ(pack(cloud, {}).size(), 0u);
  EXPECT_TRUE(pack(cloud, {}).all_identical);
  EXPECT_THROW(pack(cloud, {0}), InvalidParameter);
  cloud = *toCloud<PointT>(cube(1));
  EXPECT_THROW(pack(cloud, {-1}), InvalidParameter);
  const PackedCloud one = pack(cloud, {0});
  EXPECT_EQ(one.size(), 1u);
  EXPECT_TRUE(one.all_identical);
  EXPECT_EQ(one.points.x[0], 0.0f);
}

TEST(Unpack, AMoveStaysFiniteAndNoMoveKeepsTheSignOfZero)
{
  constexpr float kLargest = std::numeric_limits<float>::max();
  EXPECT_EQ(detail::moved(kLargest, 0.01f, 6e38), kLargest);
  EXPECT_EQ(detail::moved(-kLargest, -0.01f, 6e38), -kLargest);
  EXPECT_TRUE(std::signbit(detail::moved(-0.0f, 0.0f, 2.0)));
  EXPECT_EQ(detail::moved(1.0f, 0.25f, 2.0), 1.5f);
}

TEST(Unpack, MovesUsablePointsAndMakesHolesOfTheOthers)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(6), 2);
  (*cloud)[1].x = std::numeric_limits<float>::infinity();
  (*cloud)[3].normal_x = kNaN;
  const PackedCloud packed = pack(*cloud, everyIndex(*cloud));
  FilteredPoints filtered;
  filtered.kept = {1, 2, 3, 5};
  filtered.rows = {1, 3};
  filtered.displacements = SoaBuffer(2);
  filtered.displacements.y[1] = 0.5f;
  filtered.normals = SoaBuffer(2);
  filtered.normals.z[0] = filtered.normals.z[1] = 1;
  Cloud output;
  output.resize(4);
  unpack(*cloud, packed, filtered, output);
  EXPECT_TRUE(std::isnan(output[0].x) && std::isnan(output[0].y) && std::isnan(output[0].normal_z));
  EXPECT_EQ(position(output[1]), position((*cloud)[2]));
  EXPECT_EQ(normal(output[1]), (Vector3{0, 0, 1}));
  EXPECT_TRUE(sameBits(output[2], (*cloud)[3]));
  EXPECT_NEAR(output[3].y, (*cloud)[5].y + 0.5 * packed.frame.scale, 1e-6);
  EXPECT_EQ(output[3].x, (*cloud)[5].x);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(numberOf(output[i]), static_cast<int>(filtered.kept[i]));
  EXPECT_FALSE(output.is_dense);
}

} // namespace
} // namespace pcl_gpf::test
