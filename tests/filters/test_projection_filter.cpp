// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/filters/projection_filter.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>

#include <algorithm>
#include <set>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointXYZINormal;
using Cloud = pcl::PointCloud<PointT>;

/** \brief The smallest projection there can be: lifts every point by a tenth of the box diagonal. */
class Lift : public ProjectionFilter<PointT> {
public:
  Lift() : ProjectionFilter<PointT>("Lift", true) {}

  FilterStatistics statistics;
  std::vector<std::uint32_t> rows;
  bool every_row = false;

protected:
  FilterStatistics&
  clearStatistics() override
  {
    return statistics = {};
  }
  void
  checkParameters() const override
  {}
  void
  runOperator(const OperatorInput& input, MutableVectorsView displacements, MutableVectorsView normals) override
  {
    rows = input.rows;
    every_row = input.every_row;
    EXPECT_EQ(displacements.size, input.rows.size());
    EXPECT_EQ(normals.size, input.rows.size());
    std::fill_n(displacements.z, displacements.size, 0.1f);
  }
};

Cloud
run(Lift& lift, const Cloud::Ptr& cloud)
{
  Cloud output;
  lift.setInputCloud(cloud);
  lift.filter(output);
  return output;
}

TEST(ProjectionFilter, ADerivedFilterOfAUserWorks)
{
  const Cloud::Ptr cloud = toCloud<PointT>(plane(100), 5);
  Lift lift;
  const Cloud output = run(lift, cloud);
  EXPECT_TRUE(lift.every_row);
  ASSERT_EQ(output.size(), 100u);
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_NEAR(output[i].z - (*cloud)[i].z, 0.1 * 5 * std::sqrt(2.0), 0.02);
    EXPECT_EQ(output[i].x, (*cloud)[i].x);
    EXPECT_EQ(numberOf(output[i]), static_cast<int>(i));
  }
}

TEST(ProjectionFilter, SampleRatioIsASeededSubsetInOrder)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(1001));
  Lift lift;
  lift.setSampleRatio(0.25);
  const Cloud output = run(lift, cloud);
  const pcl::Indices first = lift.getSampleIndices();
  EXPECT_EQ(output.size(), 250u);
  EXPECT_FALSE(lift.every_row);
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
  EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), first.size());
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_EQ(numberOf(output[i]), first[i]);

  pcl::Indices together = *lift.getRemovedIndices();
  EXPECT_TRUE(std::is_sorted(together.begin(), together.end()));
  together.insert(together.end(), first.begin(), first.end());
  EXPECT_EQ(std::set<int>(together.begin(), together.end()).size(), cloud->size()) << "seeds and removed are all";

  run(lift, cloud);
  EXPECT_EQ(lift.getSampleIndices(), first) << "same seed, same choice";
  lift.setSeed(5);
  run(lift, cloud);
  EXPECT_NE(lift.getSampleIndices(), first);
  EXPECT_EQ(lift.getSeed(), 5u);
  lift.setSampleRatio(1e-9);
  EXPECT_EQ(run(lift, cloud).size(), 1u);
}

TEST(ProjectionFilter, SamplesAreUsablePointsOnlyAndUnorganised)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(1000));
  cloud->width = 10;
  cloud->height = 100;
  for (std::size_t i = 0; i < 1000; i += 4)
    (*cloud)[i].x = kNaN;
  for (std::size_t i = 1; i < 1000; i += 4)
    (*cloud)[i].normal_x = kNaN;
  Lift lift;
  lift.setSampleRatio(0.99);
  const Cloud output = run(lift, cloud);
  EXPECT_EQ(output.size(), 495u);
  EXPECT_EQ(output.height, 1u);
  EXPECT_TRUE(output.is_dense);
  for (const int index : lift.getSampleIndices())
    EXPECT_GE(index % 4, 2);
}

TEST(ProjectionFilter, ExplicitSamplesKeepTheirOrderAndCountOnce)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(100));
  (*cloud)[0].x = kNaN;
  Lift lift;
  lift.setSampleIndices({50, 3, 99, 3, 50});
  lift.setSampleRatio(0.5); // explicit samples come first
  const Cloud output = run(lift, cloud);
  EXPECT_EQ(lift.getSampleIndices(), (pcl::Indices{50, 3, 99}));
  EXPECT_EQ(lift.rows, (std::vector<std::uint32_t>{49, 2, 98})) << "rows of V, which has no point 0";
  ASSERT_EQ(output.size(), 3u);
  EXPECT_EQ(numberOf(output[0]), 50);
  EXPECT_EQ(lift.getRemovedIndices()->size(), 97u);

  pcl::Indices backwards;
  for (int i = 99; i > 0; --i)
    backwards.push_back(i);
  lift.setSampleIndices(backwards);
  run(lift, cloud);
  EXPECT_FALSE(lift.every_row) << "all of them, but in another order";
  EXPECT_EQ(lift.getSampleIndices(), backwards);
  lift.setSampleIndices({});
  lift.setSampleRatio(1);
  EXPECT_EQ(run(lift, cloud).size(), 99u);
}

TEST(ProjectionFilter, UnusableSamplesThrow)
{
  const Cloud::Ptr cloud = toCloud<PointT>(cube(100));
  (*cloud)[1].x = kNaN;
  (*cloud)[2].normal_z = kNaN;
  Lift lift;
  lift.setIndices(pcl::IndicesPtr(new pcl::Indices{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const int bad : {-1, 100, 1, 2, 8}) {
    lift.setSampleIndices({0, bad});
    EXPECT_THROW(run(lift, cloud), pcl::BadArgumentException) << bad;
  }
  lift.setSampleIndices({0, 7});
  EXPECT_EQ(run(lift, cloud).size(), 2u);
  EXPECT_EQ(*lift.getRemovedIndices(), (pcl::Indices{1, 2, 3, 4, 5, 6})) << "of setIndices()";
}

} // namespace
} // namespace pcl_gpf::test
