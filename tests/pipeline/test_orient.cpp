// SPDX-License-Identifier: BSD-3-Clause
#include "support/shapes.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/orient.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/** A sphere far from the origin, every third of its normals turned round. */
struct Cloud {
  Shape shape = sphere(2000, 0.002);
  std::vector<double> x, y, z;
  std::vector<float> normal_x, normal_y, normal_z;

  Cloud()
  {
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const float sign = i % 3 == 0 ? -1.0f : 1.0f;
      x.push_back(shape.points[i][0] + 691000);
      y.push_back(shape.points[i][1] + 5335000);
      z.push_back(shape.points[i][2] + 500);
      normal_x.push_back(sign * static_cast<float>(shape.normals[i][0]));
      normal_y.push_back(sign * static_cast<float>(shape.normals[i][1]));
      normal_z.push_back(sign * static_cast<float>(shape.normals[i][2]));
    }
  }
  DenoiseInput
  input(bool with_normals = true) const
  {
    DenoiseInput in;
    in.x = x.data();
    in.y = y.data();
    in.z = z.data();
    in.size = x.size();
    if (with_normals) {
      in.normal_x = normal_x.data();
      in.normal_y = normal_y.data();
      in.normal_z = normal_z.data();
    }
    return in;
  }
  std::size_t
  countOutward(const OrientResult& result) const
  {
    std::size_t outward = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      outward += result.normal_x[i] * shape.normals[i][0] + result.normal_y[i] * shape.normals[i][1] +
                     result.normal_z[i] * shape.normals[i][2] > 0;
    return outward;
  }
};

TEST(OrientCloud, OrientsGivenNormalsOfAFarCloud)
{
  const Cloud cloud;
  NormalOrientationParameters parameters;
  parameters.noise = 0.002;
  const OrientResult result = orientCloud(cloud.input(), parameters);
  EXPECT_EQ(cloud.countOutward(result), 2000u);
  EXPECT_EQ(result.orientation.flipped, 667u);
  EXPECT_EQ(result.estimated_normals, 0u);
  EXPECT_NEAR(result.orientation.noise, 0.002, 1e-9) << "cloud units";
}

TEST(OrientCloud, EstimatesNormalsThatAreNotThere)
{
  Cloud cloud;
  const OrientResult all = orientCloud(cloud.input(false), {});
  EXPECT_EQ(all.estimated_normals, 2000u);
  EXPECT_EQ(cloud.countOutward(all), 2000u);
  cloud.normal_x[7] = std::numeric_limits<float>::quiet_NaN();
  cloud.normal_x[8] = cloud.normal_y[8] = cloud.normal_z[8] = 0;
  const OrientResult some = orientCloud(cloud.input(), {});
  EXPECT_EQ(some.estimated_normals, 2u);
  EXPECT_EQ(cloud.countOutward(some), 2000u);
  EXPECT_NEAR(std::hypot(some.normal_x[7], some.normal_y[7], some.normal_z[7]), 1, 1e-6);
}

TEST(OrientCloud, RowsThatAreNotFiniteGetNoNormal)
{
  Cloud cloud;
  cloud.y[3] = kNaN;
  const OrientResult result = orientCloud(cloud.input(), {});
  EXPECT_EQ(result.non_finite_points, 1u);
  EXPECT_TRUE(std::isnan(result.normal_x[3]) && std::isnan(result.normal_y[3]) && std::isnan(result.normal_z[3]));
  EXPECT_EQ(cloud.countOutward(result), 1999u);
}

TEST(OrientCloud, ViewpointIsInCloudUnits)
{
  const Cloud cloud;
  const std::array<double, 3> within{691000, 5335000, 500}, nowhere{0, kNaN, 0};
  EXPECT_EQ(cloud.countOutward(orientCloud(cloud.input(), {}, &within)), 0u) << "seen from within";
  EXPECT_THROW(orientCloud(cloud.input(), {}, &nowhere), InvalidParameter);
}

TEST(OrientCloud, RefusesWhatHasNoSurfaceAndCanBeCancelled)
{
  Cloud cloud;
  EXPECT_THROW(orientCloud(cloud.input(), {}, nullptr, [](const std::string&, double) { return false; }), Cancelled);
  NormalOrientationParameters parameters;
  parameters.neighbors = 0;
  EXPECT_THROW(orientCloud(cloud.input(), parameters), InvalidParameter);
  EXPECT_THROW(orientCloud({}, {}), UnsuitableData);
  cloud.x.assign(2000, 1.0);
  cloud.y.assign(2000, 1.0);
  cloud.z.assign(2000, 1.0);
  EXPECT_THROW(orientCloud(cloud.input(), {}), UnsuitableData);
}

} // namespace
} // namespace pcl_gpf::test
