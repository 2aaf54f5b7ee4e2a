// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/shapes.h"

#include <pcl_gpf/filters/rimls_projection.h>

#include <pcl/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pcl_gpf::test {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

TEST(RIMLSProjection, ParametersSurviveARoundTrip)
{
  RimlsParameters p;
  p.scale = 5;
  p.radius = 0.25;
  p.sigma_n = 0.6;
  p.sigma_r = 0.4;
  p.fits = 4;
  p.maximum_iterations = 7;
  p.number_of_threads = 2;
  RIMLSProjection<pcl::PointNormal> rimls;
  rimls.setParameters(p);
  EXPECT_EQ(rimls.getScale(), 5);
  EXPECT_EQ(rimls.getSupportRadius(), 0.25);
  EXPECT_EQ(rimls.getSigmaN(), 0.6);
  EXPECT_EQ(rimls.getSigmaR(), 0.4);
  EXPECT_EQ(rimls.getFits(), 4u);
  EXPECT_EQ(rimls.getMaximumIterations(), 7u);
  EXPECT_EQ(rimls.getParameters().number_of_threads, 2u);
}

TEST(RIMLSProjection, TakesNoiseOffACubeAndReportsInCloudUnits)
{
  constexpr double kScale = 1000;
  const Cloud::Ptr cloud = toCloud<pcl::PointNormal>(cube(20000, 0.005), kScale, {5000, -3000, 100});
  RIMLSProjection<pcl::PointNormal> rimls;
  rimls.setInputCloud(cloud);
  Cloud output;
  rimls.filter(output);
  ASSERT_EQ(output.size(), cloud->size());
  double before = 0, after = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    // Distance from the plane of the face that the point came from.
    const auto off = [&](const pcl::PointNormal& p) {
      const double along = (p.x - 5000) * (*cloud)[i].normal_x + (p.y + 3000) * (*cloud)[i].normal_y + (p.z - 100) * (*cloud)[i].normal_z;
      return std::abs(along - ((*cloud)[i].normal_x + (*cloud)[i].normal_y + (*cloud)[i].normal_z > 0 ? kScale : 0));
    };
    before += off((*cloud)[i]);
    after += off(output[i]);
  }
  EXPECT_LT(after, before / 3);
  const RIMLSProjectionStatistics& done = rimls.getStatistics();
  EXPECT_GT(done.projection.converged, output.size() * 99 / 100);
  EXPECT_NEAR(done.projection.mean_movement, before / static_cast<double>(output.size()), 0.3 * done.projection.mean_movement);
  EXPECT_NEAR(done.spacing, kScale * std::sqrt(6.0 / 20000), 0.15 * done.spacing);
  EXPECT_NEAR(done.support_radius, 4 * 1.13 * done.spacing, 0.1 * done.support_radius);
}

TEST(RIMLSProjection, RefusesUnorientedNormalsAndNamesTheCure)
{
  const Cloud::Ptr cloud = toCloud<pcl::PointNormal>(sphere(2000));
  for (std::size_t i = 0; i < cloud->size(); i += 2) {
    (*cloud)[i].normal_x *= -1;
    (*cloud)[i].normal_y *= -1;
    (*cloud)[i].normal_z *= -1;
  }
  RIMLSProjection<pcl::PointNormal> rimls;
  rimls.setInputCloud(cloud);
  Cloud output;
  try {
    rimls.filter(output);
    FAIL();
  } catch (const pcl::BadArgumentException& error) {
    EXPECT_NE(std::string(error.what()).find("orient"), std::string::npos) << error.what();
  }
  rimls.setCheckOrientation(false);
  EXPECT_NO_THROW(rimls.filter(output));
}

} // namespace
} // namespace pcl_gpf::test
