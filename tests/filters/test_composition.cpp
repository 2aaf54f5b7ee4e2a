// SPDX-License-Identifier: BSD-3-Clause
// The filters between those of PCL, in one chain.
#include "support/clouds.h"

#include <pcl_gpf/filters/bilateral_normal_filter.h>
#include <pcl_gpf/filters/gpf.h>

#include <gtest/gtest.h>

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;

void
runInPlace(pcl::Filter<PointT>& filter, const Cloud::Ptr& cloud)
{
  filter.setInputCloud(cloud);
  filter.filter(*cloud);
}

double
meanDistanceToSphere(const Cloud& cloud)
{
  double sum = 0;
  for (const PointT& point : cloud)
    sum += std::abs(distance(position(point), {0, 0, 0}) - 0.5);
  return sum / static_cast<double>(cloud.size());
}

TEST(Composition, WorksAmongTheFiltersOfPcl)
{
  Shape shape = sphere(8000, 0.004);
  for (std::size_t i = 0; i < shape.size(); i += 400)
    shape.points[i] = {2.0 + 0.1 * static_cast<double>(i % 7), 0.01 * static_cast<double>(i), 0};
  const Cloud::Ptr cloud = toCloud<PointT>(shape);
  cloud->header.frame_id = "scanner";

  pcl::VoxelGrid<PointT> voxels;
  voxels.setLeafSize(0.02f, 0.02f, 0.02f);
  pcl::StatisticalOutlierRemoval<PointT> outliers;
  outliers.setMeanK(10);
  outliers.setStddevMulThresh(3);
  BilateralNormalFilter<PointT> bilateral;
  GPF<PointT> gpf;
  runInPlace(voxels, cloud);
  runInPlace(outliers, cloud);
  const double before = meanDistanceToSphere(*cloud);
  const std::size_t count = cloud->size();
  runInPlace(bilateral, cloud);
  runInPlace(gpf, cloud);
  EXPECT_EQ(cloud->size(), count);
  EXPECT_EQ(cloud->header.frame_id, "scanner");
  EXPECT_LT(meanDistanceToSphere(*cloud), 0.7 * before);

  pcl::MovingLeastSquares<PointT, PointT> mls;
  mls.setInputCloud(cloud);
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<PointT>>());
  mls.setSearchRadius(0.1);
  Cloud smooth;
  mls.process(smooth);
  EXPECT_LE(smooth.size(), count) << "MLS drops points without neighbours";
  EXPECT_GT(smooth.size(), count - 20);
  EXPECT_LT(meanDistanceToSphere(smooth), 0.7 * before);
}

TEST(Composition, OwnOutputIsInputAgain)
{
  const Cloud::Ptr cloud = toCloud<PointT>(sphere(3000, 0.004));
  GPF<PointT> gpf;
  gpf.setSupportRadius(0.15);
  runInPlace(gpf, cloud);
  const double once = meanDistanceToSphere(*cloud);
  runInPlace(gpf, cloud);
  EXPECT_LT(meanDistanceToSphere(*cloud), 1.2 * once);
}

} // namespace
} // namespace pcl_gpf::test
