// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/noise.h>
#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/analysis/spacing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::test {
namespace {

struct Parameters {
  PlaneNormalsParameters normals;
  BilateralNormalsParameters bilateral;
  GPFParameters gpf;
};

std::vector<ParameterOrigin>
estimate(const CloudScale& scale, Parameters& p)
{
  return estimateParameters(scale, p.normals, p.bilateral, p.gpf);
}

const ParameterOrigin&
find(const std::vector<ParameterOrigin>& origins, const std::string& name)
{
  const auto found = std::find_if(origins.begin(), origins.end(), [&](const ParameterOrigin& o) { return o.name == name; });
  if (found == origins.end())
    throw std::out_of_range(name);
  return *found;
}

const CloudScale kScale = {0.01, 0.004, 1.5, 0.015}; // spacing, noise, diagonal, h0

TEST(MeasureScale, putsItsMeasurementsTogether)
{
  const Shape shape = turned(cube(4000, 0.01, 1));
  const SoaBuffer points = toBuffer(shape.points);
  BoundingBox box;
  for (const Vector3& p : toVectors(points))
    box.add(p[0], p[1], p[2]);
  const CloudScale scale = measureScale(points.view());
  EXPECT_NEAR(scale.diagonal, box.diagonal(), 1e-12);
  EXPECT_NEAR(scale.h0, box.diagonal() / std::sqrt(4000.0), 1e-12);
  const double apparent = estimateSpacing(points.view());
  EXPECT_EQ(scale.noise, estimateNoise(points.view(), apparent));
  EXPECT_EQ(scale.spacing, spacingWithoutNoise(apparent, scale.noise));
  EXPECT_EQ(measureScale({}).diagonal, 0.0);
}

TEST(MeasureScale, countsRepeatedPositionsOnce)
{
  const Shape once = turned(cube(4000, 0.01, 1));
  const CloudScale scale = measureScale(toBuffer(once.points).view());
  Shape eightfold, with_pile = once;
  for (std::size_t i = 0; i < once.size(); ++i)
    for (int copy = 0; copy < 8; ++copy)
      append(eightfold, once.points[i], once.normals[i]);
  for (std::size_t i = 0; i < once.size(); ++i) // half of all points in one place, as invalid returns are
    append(with_pile, once.points[0], once.normals[0]);
  for (const Shape& shape : {eightfold, with_pile}) {
    const CloudScale repeated = measureScale(toBuffer(shape.points).view());
    EXPECT_NEAR(repeated.noise, scale.noise, 0.1 * scale.noise);
    EXPECT_NEAR(repeated.spacing, scale.spacing, 0.1 * scale.spacing);
    EXPECT_EQ(repeated.diagonal, scale.diagonal);
  }
}

TEST(EstimateParameters, fillsEveryRadiusAndTellsWhy)
{
  Parameters p;
  const auto origins = estimate(kScale, p);
  ASSERT_EQ(origins.size(), 3u);
  EXPECT_EQ(find(origins, "normals.radius").value, p.normals.radius);
  EXPECT_EQ(find(origins, "bilateral.radius").value, p.bilateral.radius);
  EXPECT_EQ(find(origins, "gpf.support_radius").value, p.gpf.support_radius);
  for (const ParameterOrigin& origin : origins) {
    EXPECT_GT(origin.value, kScale.spacing);
    EXPECT_EQ(origin.origin, "estimated");
    EXPECT_FALSE(origin.reason.empty());
  }
  EXPECT_LT(p.normals.radius, p.gpf.support_radius);
}

TEST(EstimateParameters, keepsWhatTheUserSet)
{
  Parameters p;
  p.normals.radius = 0.123;
  p.bilateral.radius = 0.456;
  p.gpf.support_radius = 0.789;
  for (const ParameterOrigin& origin : estimate(kScale, p))
    EXPECT_EQ(origin.origin, "user") << origin.name;
  EXPECT_EQ(p.normals.radius, 0.123);
  EXPECT_EQ(p.bilateral.radius, 0.456);
  EXPECT_EQ(p.gpf.support_radius, 0.789);
}

TEST(EstimateParameters, leavesTheBilateralRadiusToTheNeighborsWhenTheyAreSet)
{
  Parameters p;
  p.bilateral.neighbors = 20;
  EXPECT_THROW(find(estimate(kScale, p), "bilateral.radius"), std::out_of_range);
  EXPECT_EQ(p.bilateral.radius, 0.0);
  EXPECT_NO_THROW(validate(p.bilateral));
}

TEST(EstimateParameters, growsWithNoiseButNotBelowWhatTheSpacingAsksFor)
{
  const auto radius = [](double noise) {
    Parameters p;
    estimate({0.01, noise, 1.5, 0.015}, p);
    return p.gpf.support_radius;
  };
  EXPECT_GT(radius(0.02), 1.5 * radius(0.01));
  EXPECT_NEAR(radius(1e-6), radius(0.0), 1e-8);
  EXPECT_GT(radius(0.0), 3 * 0.01);
}

/** But for the first plane fits: those of the coarse scale are filtered over so wide a ball that rough normals do. */
TEST(EstimateParameters, finerScalesAreBelowTheOthersInEveryLengthThatFilters)
{
  for (const double noise : {0.0, 0.004, 0.01, 0.1}) {
    Parameters fine, coarse;
    const CloudScale scale{0.01, noise, 1.5, 0.015};
    estimateParameters(scale, fine.normals, fine.bilateral, fine.gpf, FilterScale::Fine);
    estimateParameters(scale, coarse.normals, coarse.bilateral, coarse.gpf, FilterScale::Coarse);
    EXPECT_LT(fine.bilateral.radius, coarse.bilateral.radius);
    EXPECT_LT(fine.gpf.support_radius, coarse.gpf.support_radius);
    Parameters finest;
    estimateParameters(scale, finest.normals, finest.bilateral, finest.gpf, FilterScale::Finest);
    EXPECT_LT(finest.normals.radius, fine.normals.radius);
    EXPECT_LT(finest.bilateral.radius, fine.bilateral.radius);
    EXPECT_LT(finest.gpf.support_radius, fine.gpf.support_radius);
  }
}

TEST(EstimateParameters, areLengths)
{
  for (const double s : {1e-6, 1e6}) {
    Parameters unit, scaled;
    estimate(kScale, unit);
    estimate({s * kScale.spacing, s * kScale.noise, s * kScale.diagonal, s * kScale.h0}, scaled);
    EXPECT_NEAR(scaled.normals.radius / s, unit.normals.radius, 1e-12);
    EXPECT_NEAR(scaled.bilateral.radius / s, unit.bilateral.radius, 1e-12);
    EXPECT_NEAR(scaled.gpf.support_radius / s, unit.gpf.support_radius, 1e-12);
  }
}

TEST(EstimateParameters, takesThePapersRadiusForItsAlgorithm)
{
  Parameters p;
  p.gpf = GPFParameters::paper();
  EXPECT_EQ(find(estimate(kScale, p), "gpf.support_radius").origin, "preset");
  EXPECT_DOUBLE_EQ(p.gpf.support_radius, 8 * kScale.h0);
}

} // namespace
} // namespace pcl_gpf::test
