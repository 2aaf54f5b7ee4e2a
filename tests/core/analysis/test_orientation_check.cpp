// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/orientation_check.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/plane_normals.h>

#include <gtest/gtest.h>

#include <string>

namespace pcl_gpf::test {
namespace {

SoaBuffer
flippedBy(const LocalCloud& cloud, bool (*flip)(SplitMix64&, const Vector3&))
{
  SplitMix64 random(4);
  std::vector<Vector3> normals = cloud.b;
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (flip(random, cloud.v[i]))
      for (double& component : normals[i])
        component = -component;
  return toBuffer(normals);
}

void
require(const LocalCloud& cloud, const SoaBuffer& normals)
{
  requireConsistentOrientation(cloud.points.view(), normals.view());
}

TEST(OrientationCheck, acceptsConsistentNormalsOfEitherSide)
{
  for (const Shape& shape : {sphere(3000, 0.005), cube(3000, 0.005), plane(3000, 0.002), edge(3000, 0.003), sphere(60), cube(8)}) {
    const LocalCloud cloud = toLocalCloud(turned(shape));
    EXPECT_NO_THROW(require(cloud, cloud.normals));
    EXPECT_NO_THROW(require(cloud, flippedBy(cloud, [](SplitMix64&, const Vector3&) { return true; })));
    EXPECT_NO_THROW(require(cloud, flippedBy(cloud, [](SplitMix64& random, const Vector3&) { return random.below(100) == 0; })));
  }
}

TEST(OrientationCheck, acceptsPartsThatLookToDifferentSides)
{
  Shape two = sphere(2000);
  const Shape other = sphere(2000, 0, 5);
  for (std::size_t i = 0; i < other.size(); ++i)
    append(two, {other.points[i][0] + 3, other.points[i][1], other.points[i][2]}, {-other.normals[i][0], -other.normals[i][1], -other.normals[i][2]});
  const LocalCloud cloud = toLocalCloud(turned(two));
  EXPECT_NO_THROW(require(cloud, cloud.normals));
}

TEST(OrientationCheck, refusesRandomSignsPlaneFitsAndAFlippedPatchAndNamesTheCure)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(3000, 0.005)));
  EXPECT_THROW(require(cloud, flippedBy(cloud, [](SplitMix64& random, const Vector3&) { return random.below(2) == 0; })), InvalidParameter);
  EXPECT_THROW(require(cloud, flippedBy(cloud, [](SplitMix64&, const Vector3& p) { return p[0] > 0.1; })), InvalidParameter);
  PlaneNormalsParameters p;
  p.radius = 0.05;
  SoaBuffer fitted(cloud.size());
  estimatePlaneNormals(p, cloud.points.view(), fitted.view());
  try {
    require(cloud, fitted);
    FAIL() << "signs of plane fits follow the axes";
  } catch (const InvalidParameter& error) {
    EXPECT_NE(std::string(error.what()).find("orient"), std::string::npos) << error.what();
  }
}

TEST(OrientationCheck, takesTinyClouds)
{
  for (const std::size_t size : {0u, 1u, 2u, 3u}) {
    const LocalCloud cloud = toLocalCloud(plane(size));
    EXPECT_NO_THROW(require(cloud, cloud.normals));
  }
}

} // namespace
} // namespace pcl_gpf::test
