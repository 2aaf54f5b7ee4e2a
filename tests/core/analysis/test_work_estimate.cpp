// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/analysis/work_estimate.h>
#include <pcl_gpf/core/errors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_gpf::test {
namespace {

/** Pairs within the radius, a point. */
double
pairsPerPoint(const LocalCloud& cloud, double radius)
{
  std::size_t pairs = 0;
  for (const Vector3& a : cloud.v)
    for (const Vector3& b : cloud.v) {
      const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
      pairs += d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < radius * radius;
    }
  return static_cast<double>(pairs) / static_cast<double>(cloud.size());
}

TEST(WorkEstimate, countsThePairsOfABallWithinAFactor)
{
  const LocalCloud cloud = toLocalCloud(cube(4000, 0.01, 3));
  const PointIndex index(cloud.points.view());
  for (const double radius : {0.03, 0.1, 0.4, 2.0}) {
    PlaneNormalsParameters planes;
    planes.radius = radius;
    planes.merge_above = 0;
    const double exact = pairsPerPoint(cloud, radius);
    const WorkEstimate work = estimateWork(planes, index);
    EXPECT_GT(work.data_per_point, 0.9 * exact) << radius; // a sample of the blocks
    if (radius > 0.05) {
      EXPECT_LT(work.data_per_point, 6.0 * exact) << radius; // boxes about blocks and clusters
    }
    EXPECT_EQ(work.pairs, 4000.0 * work.data_per_point) << radius;
    EXPECT_FALSE(isExcessive(work)) << "small clouds may look at everything";
  }
}

TEST(WorkEstimate, followsWhatTheParametersAskFor)
{
  const LocalCloud cloud = toLocalCloud(sphere(20000, 0.01, 3));
  const PointIndex index(cloud.points.view());
  GPFParameters p;
  p.support_radius = 0.5;
  const WorkEstimate merged = estimateWork(p, index, cloud.size());
  EXPECT_LT(merged.data_per_point, 1000.0) << "means stand for points";
  const WorkEstimate foreign = estimateWork(p, index, cloud.size(), true);
  EXPECT_GT(foreign.data_per_point, 2.0 * merged.data_per_point);
  p.merge_above = 0;
  const WorkEstimate all = estimateWork(p, index, cloud.size());
  EXPECT_EQ(all.pairs, foreign.pairs);
  EXPECT_NEAR(estimateWork(p, index, cloud.size() / 2).pairs, 0.5 * all.pairs, 1e-6 * all.pairs);
  p.maximum_iterations *= 2;
  EXPECT_NEAR(estimateWork(p, index, cloud.size()).pairs, 2.0 * all.pairs, 1e-6 * all.pairs);
  GPFParameters paper = GPFParameters::paper();
  paper.support_radius = p.support_radius;
  EXPECT_GT(estimateWork(paper, index, cloud.size()).nominal_seconds, 3.0 * all.nominal_seconds)
      << "double, and more sums";

  BilateralNormalsParameters bilateral;
  bilateral.radius = 0.25;
  const WorkEstimate fast = estimateWork(bilateral, index);
  bilateral.sign_invariant = false; // every point is its own mean
  EXPECT_GT(estimateWork(bilateral, index).pairs, 5.0 * fast.pairs);
}

TEST(WorkEstimate, sensibleRadiiAreNotExcessiveAndTheWholeCloudIs)
{
  const LocalCloud cloud = toLocalCloud(cube(100000, 0.03, 3));
  const PointIndex index(cloud.points.view());
  for (const double share : {0.01, 0.03, 0.1, 0.2, 0.5, 2.0}) {
    GPFParameters gpf;
    gpf.support_radius = share;
    EXPECT_FALSE(isExcessive(estimateWork(gpf, index, cloud.size()))) << share << ": means bound the work";
    BilateralNormalsParameters bilateral;
    bilateral.radius = share;
    EXPECT_FALSE(isExcessive(estimateWork(bilateral, index))) << share;
    PlaneNormalsParameters planes;
    planes.radius = share;
    EXPECT_FALSE(isExcessive(estimateWork(planes, index))) << share;
    gpf.merge_above = 0;
    EXPECT_EQ(isExcessive(estimateWork(gpf, index, cloud.size())), share > 0.5) << share;
  }
  GPFParameters paper = GPFParameters::paper();
  for (const double h0s : {3.0, 8.0, 12.0}) { // the range of the paper
    paper.support_radius = h0s / std::sqrt(1e5);
    EXPECT_FALSE(isExcessive(estimateWork(paper, index, cloud.size() / 2))) << h0s;
  }
  paper.support_radius = 0.5;
  EXPECT_TRUE(isExcessive(estimateWork(paper, index, cloud.size() / 2)));
  EXPECT_THROW(refuseExcessiveWork(estimateWork(paper, index, cloud.size() / 2)), ExcessiveWork);
}

TEST(WorkEstimate, takesDegenerateClouds)
{
  for (const std::size_t size : {0u, 1u, 2u, 3u}) {
    const LocalCloud cloud = toLocalCloud(plane(size));
    const PointIndex index(cloud.points.view());
    GPFParameters gpf = GPFParameters::paper();
    gpf.support_radius = 1e300;
    const WorkEstimate work = estimateWork(gpf, index, size);
    EXPECT_LE(work.data_per_point, static_cast<double>(size));
    EXPECT_FALSE(isExcessive(work));
  }
}

} // namespace
} // namespace pcl_gpf::test
