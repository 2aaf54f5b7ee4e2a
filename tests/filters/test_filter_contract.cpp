// SPDX-License-Identifier: BSD-3-Clause
#include "filters/filter_contract.h"

#include <pcl/exceptions.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>
#include <pcl/search/organized.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace pcl_gpf::test {

#define USING_FIXTURE                                                  \
  using Fixture [[maybe_unused]] = FilterContract<TypeParam>;          \
  using Contract [[maybe_unused]] = ContractOf<TypeParam>;             \
  using PointT [[maybe_unused]] = typename Contract::Point;            \
  using Cloud [[maybe_unused]] = pcl::PointCloud<PointT>;              \
  using CloudPtr [[maybe_unused]] = typename Cloud::Ptr

/** \brief Makes the name visible. */
template <typename FilterT>
struct Named : FilterT {
  using FilterT::getClassName;
};

TYPED_TEST(FilterContract, NameAndTypes)
{
  USING_FIXTURE;
  EXPECT_EQ(Named<TypeParam>().getClassName(), Contract::kName);
  static_assert(!std::is_convertible<bool, TypeParam>::value, "the constructor is explicit");
  typename TypeParam::Ptr filter(new TypeParam);
  const typename TypeParam::ConstPtr constant = filter;
  const pcl::Filter<PointT>& base = *constant;
  EXPECT_TRUE(base.getRemovedIndices()->empty());
}

TYPED_TEST(FilterContract, SettersHaveGetters)
{
  USING_FIXTURE;
  const typename pcl::search::Search<PointT>::Ptr search(new pcl::search::KdTree<PointT>);
  EXPECT_FALSE(this->filter_.getSearchMethod());
  this->filter_.setSearchMethod(search);
  EXPECT_EQ(this->filter_.getSearchMethod(), search);
  EXPECT_EQ(this->filter_.getNumberOfThreads(), 0u);
  this->filter_.setNumberOfThreads(3);
  EXPECT_EQ(this->filter_.getNumberOfThreads(), 3u);
  EXPECT_EQ(this->filter_.getParameters().number_of_threads, 3u);
  this->filter_.setNumberOfThreads();
  EXPECT_EQ(this->filter_.getNumberOfThreads(), 0u);
  EXPECT_FALSE(this->filter_.getProgressCallback());
  this->filter_.setProgressCallback([](double) { return true; });
  EXPECT_TRUE(this->filter_.getProgressCallback());
}

TYPED_TEST(FilterContract, KeepsHeaderPoseAndForeignFields)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  cloud->header.frame_id = "scanner";
  cloud->header.stamp = 42;
  cloud->header.seq = 7;
  cloud->sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  cloud->sensor_orientation_ = Eigen::Quaternionf(0.5f, 0.5f, 0.5f, 0.5f);
  const Cloud output = this->run(cloud);
  EXPECT_EQ(output.header, cloud->header);
  EXPECT_EQ(output.sensor_origin_, cloud->sensor_origin_);
  EXPECT_EQ(output.sensor_orientation_.coeffs(), cloud->sensor_orientation_.coeffs());
  ASSERT_EQ(output.size(), cloud->size());
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_EQ(numberOf(output[i]), static_cast<int>(i));
  EXPECT_FALSE(sameBits(output, *cloud)) << "the filter did something";
}

TYPED_TEST(FilterContract, FiltersInPlaceAsBeside)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->organisedCube();
  cloud->header.frame_id = "scanner";
  const Cloud beside = this->run(cloud);
  this->filter_.filter(*cloud);
  EXPECT_TRUE(sameBits(beside, *cloud));
  EXPECT_EQ(cloud->header.frame_id, "scanner");
  EXPECT_EQ(cloud->width, beside.width);
  EXPECT_EQ(cloud->height, beside.height);
}

TYPED_TEST(FilterContract, NormalsAreUnitVectorsWhateverTheirLength)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const Cloud expected = this->run(cloud);
  for (PointT& point : *cloud) {
    point.normal_x *= 1000;
    point.normal_y *= 1000;
    point.normal_z *= 1000;
  }
  const Cloud output = this->run(cloud);
  EXPECT_LT(largestDistance(output, expected), 1e-5);
  EXPECT_LT(largestTurn(output, expected), 1e-5);
  for (const PointT& point : output)
    EXPECT_NEAR(distance(normal(point), {0, 0, 0}), 1, 1e-6);
}

TYPED_TEST(FilterContract, UnorganisedCloudWithNonFinitePoints)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  this->makeNonFinite((*cloud)[3]);
  (*cloud)[10].x = std::numeric_limits<float>::infinity();
  cloud->is_dense = false;
  const Cloud output = this->run(cloud);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_EQ(output.size(), cloud->size() - (Contract::kKeepsNonFinite ? 0 : 2));
  EXPECT_EQ(output.is_dense, !Contract::kKeepsNonFinite);
  EXPECT_EQ(*this->filter_.getRemovedIndices(), (pcl::Indices{3, 10}));
  EXPECT_EQ(this->filter_.getStatistics().non_finite_points, 2u);
  EXPECT_EQ(this->filter_.getStatistics().points, cloud->size() - 2);
  ASSERT_EQ(this->filter_.getSampleIndices().size(), output.size());
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_EQ(this->filter_.getSampleIndices()[i], numberOf(output[i]));
}

TYPED_TEST(FilterContract, OrganisedCloudStaysOrganisedWithItsHoles)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->organisedCube();
  const std::vector<std::size_t> holes{0, 21, 22, Fixture::kCount - 1};
  for (const std::size_t hole : holes)
    this->makeNonFinite((*cloud)[hole]);
  cloud->is_dense = false;
  const Cloud output = this->run(cloud);
  EXPECT_EQ(output.width, 20u);
  EXPECT_EQ(output.height, Fixture::kCount / 20);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_FALSE(output.is_dense);
  for (std::size_t i = 0; i < output.size(); ++i) {
    const bool hole = std::find(holes.begin(), holes.end(), i) != holes.end();
    EXPECT_EQ(std::isnan(output[i].x) && std::isnan(output[i].y) && std::isnan(output[i].z), hole);
    EXPECT_EQ(std::isnan(output[i].normal_x), hole);
    EXPECT_EQ(numberOf(output[i]), static_cast<int>(i));
  }
  EXPECT_EQ(*this->filter_.getRemovedIndices(), pcl::Indices(holes.begin(), holes.end()));
}

TYPED_TEST(FilterContract, DenseFlagOfTheInputIsNotTrusted)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->organisedCube();
  this->makeNonFinite((*cloud)[5]);
  cloud->is_dense = true;
  const Cloud output = this->run(cloud);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_FALSE(output.is_dense);
}

TYPED_TEST(FilterContract, WrongWidthAndHeightOfTheInputAreNotCopied)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  cloud->width = 7;
  cloud->height = 3;
  const Cloud output = this->run(cloud);
  EXPECT_EQ(output.size(), cloud->size());
  EXPECT_TRUE(this->wellFormed(output));
}

TYPED_TEST(FilterContract, IndicesAreTheDataSet)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->organisedCube();
  const CloudPtr chosen(new Cloud);
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = static_cast<int>(Fixture::kCount) - 1; i >= 0; i -= 2) {
    indices->push_back(i);
    chosen->push_back((*cloud)[static_cast<std::size_t>(i)]);
  }
  const Cloud expected = this->run(chosen);
  this->filter_.setIndices(indices);
  const Cloud output = this->run(cloud);
  EXPECT_TRUE(sameBits(output, expected)) << "points outside the indices had influence";
  EXPECT_EQ(output.height, 1u);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_EQ(this->filter_.getSampleIndices(), *indices) << "the order is that of the indices";
  EXPECT_TRUE(this->filter_.getRemovedIndices()->empty());

  this->filter_.setIndices(pcl::IndicesPtr());
  EXPECT_EQ(this->run(cloud).size(), cloud->size()) << "back to all";
}

TYPED_TEST(FilterContract, EveryFormOfIndicesWorks)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->organisedCube();
  pcl::PointIndices::Ptr point_indices(new pcl::PointIndices);
  for (int row = 2; row < 12; ++row)
    for (int column = 4; column < 14; ++column)
      point_indices->indices.push_back(row * 20 + column);
  this->filter_.setIndices(point_indices);
  const Cloud by_list = this->run(cloud);
  this->filter_.setIndices(2, 4, 10, 10);
  const Cloud by_window = this->run(cloud);
  EXPECT_EQ(by_list.size(), 100u);
  EXPECT_TRUE(sameBits(by_list, by_window));
}

TYPED_TEST(FilterContract, AnIndexGivenTwiceCountsOnce)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const pcl::IndicesPtr once(new pcl::Indices(Fixture::kCount)), twice(new pcl::Indices);
  std::iota(once->begin(), once->end(), 0);
  for (const int index : *once)
    twice->insert(twice->end(), {index, index / 2, index});
  this->filter_.setIndices(once);
  const Cloud expected = this->run(cloud);
  this->filter_.setIndices(twice);
  const Cloud output = this->run(cloud);
  EXPECT_EQ(this->filter_.getSampleIndices(), *once);
  EXPECT_TRUE(sameBits(output, expected));
}

TYPED_TEST(FilterContract, IndicesOutOfRangeThrowAndTheObjectWorksAfterwards)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const Cloud expected = this->run(cloud);
  for (const int bad : {-1, static_cast<int>(Fixture::kCount)}) {
    this->filter_.setIndices(pcl::IndicesPtr(new pcl::Indices{0, 1, bad}));
    Cloud output = *cloud;
    EXPECT_THROW(this->filter_.filter(output), pcl::BadArgumentException);
    EXPECT_TRUE(output.empty() && this->wellFormed(output)) << "stale output";
  }
  const CloudPtr small = this->noisyCube(10); // indices survive setInputCloud()
  this->filter_.setIndices(pcl::IndicesPtr(new pcl::Indices{300}));
  EXPECT_THROW(this->run(small), pcl::BadArgumentException);
  this->filter_.setIndices(pcl::IndicesPtr());
  EXPECT_TRUE(sameBits(this->run(cloud), expected));
}

TYPED_TEST(FilterContract, NoIndicesAtAllGiveAnEmptyCloud)
{
  USING_FIXTURE;
  this->filter_.setIndices(pcl::IndicesPtr(new pcl::Indices));
  const Cloud output = this->run(this->noisyCube());
  EXPECT_TRUE(output.empty() && this->wellFormed(output));
}

TYPED_TEST(FilterContract, RemovedIndicesAreClearedAndOnlyCollectedOnRequest)
{
  USING_FIXTURE;
  const CloudPtr holed = this->noisyCube();
  this->makeNonFinite((*holed)[7]);
  this->run(holed);
  const pcl::IndicesConstPtr first = this->filter_.getRemovedIndices();
  this->run(this->noisyCube());
  EXPECT_TRUE(this->filter_.getRemovedIndices()->empty());
  EXPECT_EQ(*first, pcl::Indices{7}) << "a list once handed out does not change";

  TypeParam plain;
  Contract::prepare(plain);
  plain.setInputCloud(holed);
  Cloud output;
  plain.filter(output);
  EXPECT_TRUE(plain.getRemovedIndices()->empty());
}

TYPED_TEST(FilterContract, PointsWithoutANormalAreCopiedAndAreNoData)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const CloudPtr without(new Cloud);
  const auto unusable = [](std::size_t i) { return i % 50 == 0; };
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    PointT& point = (*cloud)[i];
    if (!unusable(i))
      without->push_back(point);
    else if (i % 100 == 0)
      point.normal_x = point.normal_y = point.normal_z = 0;
    else
      point.normal_z = kNaN;
  }
  // The box must not depend on them either, else bits could differ.
  const Cloud expected = this->run(without);
  ::testing::internal::CaptureStderr();
  const Cloud output = this->run(cloud);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("8 of 400 points have no usable normal"), std::string::npos);
  ASSERT_EQ(output.size(), cloud->size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    const PointT& twin = unusable(i) ? (*cloud)[i] : expected[next++];
    EXPECT_TRUE(sameBits(output[i], twin)) << i;
  }
  EXPECT_EQ(this->filter_.getStatistics().points_without_normal, 8u);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_FALSE(output.is_dense);
}

TYPED_TEST(FilterContract, NoUsableNormalAtAllThrowsWithTheCure)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  for (PointT& point : *cloud)
    point.normal_x = point.normal_y = point.normal_z = 0;
  try {
    this->run(cloud);
    FAIL() << "nothing was thrown";
  }
  catch (const pcl::BadArgumentException& error) {
    EXPECT_NE(std::string(error.what()).find("estimateNormals"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(Contract::kName), std::string::npos);
  }
}

TYPED_TEST(FilterContract, EmptyCloudAndNothingFinite)
{
  USING_FIXTURE;
  ::testing::internal::CaptureStderr();
  const Cloud empty = this->run(CloudPtr(new Cloud));
  EXPECT_TRUE(empty.empty() && this->wellFormed(empty));

  const CloudPtr holes = this->organisedCube();
  for (PointT& point : *holes)
    this->makeNonFinite(point);
  const Cloud output = this->run(holes);
  EXPECT_EQ(output.width, holes->width);
  EXPECT_EQ(output.height, holes->height);
  EXPECT_TRUE(this->wellFormed(output));
  EXPECT_TRUE(std::all_of(output.begin(), output.end(), [](const PointT& point) { return std::isnan(point.x); }));

  const std::string messages = ::testing::internal::GetCapturedStderr();
  const std::string head = "[pcl_gpf::" + std::string(Contract::kName) + "::applyFilter] ";
  EXPECT_NE(messages.find(head + "None of the 0 points"), std::string::npos);
  EXPECT_NE(messages.find("None of the 400 points is finite"), std::string::npos);
}

TYPED_TEST(FilterContract, TooFewAndIdenticalPointsAreCopiedWithAWarning)
{
  USING_FIXTURE;
  for (const std::size_t count : {1u, 2u, 3u}) {
    const CloudPtr cloud = toCloud<PointT>(cube(count));
    ::testing::internal::CaptureStderr();
    const Cloud output = this->run(cloud);
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("span no surface"), std::string::npos);
    EXPECT_TRUE(sameBits(output, *cloud));
    EXPECT_TRUE(this->wellFormed(output));
  }
  const CloudPtr identical(new Cloud);
  identical->resize(100, (*toCloud<PointT>(cube(1)))[0]);
  const Cloud output = this->run(identical);
  EXPECT_TRUE(sameBits(output, *identical));
}

TYPED_TEST(FilterContract, TwoPilesOfPointsStayWhereTheyAre)
{
  USING_FIXTURE;
  const CloudPtr cloud(new Cloud);
  cloud->resize(40, (*toCloud<PointT>(cube(1)))[0]);
  for (std::size_t i = 0; i < cloud->size(); i += 2)
    (*cloud)[i].x += 1;
  EXPECT_TRUE(sameBits(this->run(cloud), *cloud));
  TypeParam plain; // with every parameter estimated
  plain.setInputCloud(cloud);
  Cloud output;
  plain.filter(output);
  EXPECT_TRUE(sameBits(output, *cloud));
}

TYPED_TEST(FilterContract, CollinearPointsStayFiniteAndOnTheirLine)
{
  USING_FIXTURE;
  const CloudPtr cloud(new Cloud);
  for (int i = 0; i < 50; ++i) {
    PointT point;
    point.x = 0.02f * static_cast<float>(i);
    point.normal_z = 1;
    cloud->push_back(point);
  }
  const Cloud output = this->run(cloud);
  EXPECT_TRUE(sameBits(output, *cloud));
  Cloud estimated; // with every parameter estimated
  TypeParam plain;
  plain.setInputCloud(cloud);
  plain.filter(estimated);
  EXPECT_TRUE(sameBits(estimated, *cloud));
}

TYPED_TEST(FilterContract, WithoutInputTheOutputIsLeftAlone)
{
  USING_FIXTURE;
  TypeParam filter;
  Cloud output = *this->noisyCube();
  ::testing::internal::CaptureStderr();
  filter.filter(output);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("No input set"), std::string::npos);
  EXPECT_TRUE(sameBits(output, *this->noisyCube()));
}

TYPED_TEST(FilterContract, InvalidParametersThrowAndTheObjectWorksAfterwards)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const Cloud expected = this->run(cloud);
  Contract::setInvalidParameter(this->filter_);
  Cloud output = *cloud;
  EXPECT_THROW(this->filter_.filter(output), pcl::BadArgumentException);
  EXPECT_TRUE(output.empty());
  EXPECT_TRUE(this->filter_.getSampleIndices().empty());
  const CloudPtr in_place(new Cloud(*cloud));
  this->filter_.setInputCloud(in_place);
  EXPECT_THROW(this->filter_.filter(*in_place), pcl::BadArgumentException);
  EXPECT_TRUE(sameBits(*in_place, *cloud)) << "an in-place call that throws leaves the cloud as it was";
  Contract::prepare(this->filter_);
  EXPECT_TRUE(sameBits(this->run(cloud), expected));
}

TYPED_TEST(FilterContract, CancellingLeavesAnEmptyCloud)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  const Cloud expected = this->run(cloud);
  this->filter_.setProgressCallback([](double fraction) { return fraction < 0.3; });
  ::testing::internal::CaptureStderr();
  const Cloud output = this->run(cloud);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("Cancelled"), std::string::npos);
  EXPECT_TRUE(output.empty() && this->wellFormed(output));
  EXPECT_TRUE(this->filter_.getStatistics().cancelled);
  this->filter_.setProgressCallback({});
  EXPECT_TRUE(sameBits(this->run(cloud), expected));
  EXPECT_FALSE(this->filter_.getStatistics().cancelled);
}

TYPED_TEST(FilterContract, ProgressRisesToOneAndItsExceptionsPass)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  std::vector<double> fractions;
  this->filter_.setProgressCallback([&](double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  const Cloud expected = this->run(cloud);
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
  this->filter_.setProgressCallback([](double) -> bool { throw std::domain_error("from the callback"); });
  EXPECT_THROW(this->run(cloud), std::domain_error);
  this->filter_.setProgressCallback({});
  EXPECT_TRUE(sameBits(this->run(cloud), expected));
}

TYPED_TEST(FilterContract, SameBitsForAnyNumberOfThreadsAndAtEveryCall)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube(5000);
  this->filter_.setNumberOfThreads(1);
  const Cloud expected = this->run(cloud);
  for (const unsigned threads : {2u, 3u, 7u, 1u}) {
    this->filter_.setNumberOfThreads(threads);
    EXPECT_TRUE(sameBits(this->run(cloud), expected)) << threads << " threads";
  }
}

TYPED_TEST(FilterContract, AnySearchMethodGivesTheSameAnswer)
{
  USING_FIXTURE;
  constexpr double kTolerance = 1e-5 * 0.2;
  const CloudPtr cloud = toCloud<PointT>(cube(2000, 0.01));
  const Cloud expected = this->run(cloud);
  const typename pcl::search::Search<PointT>::Ptr searches[] = {
      typename pcl::search::Search<PointT>::Ptr(new pcl::search::KdTree<PointT>(false)),
      typename pcl::search::Search<PointT>::Ptr(new pcl::search::KdTree<PointT>(true)),
      typename pcl::search::Search<PointT>::Ptr(new pcl::search::Octree<PointT>(0.1))};
  for (const auto& search : searches) {
    this->filter_.setSearchMethod(search);
    const Cloud output = this->run(cloud);
    EXPECT_LT(largestDistance(output, expected), kTolerance) << search->getName();
    EXPECT_LT(largestTurn(output, expected), 1e-5) << search->getName();
  }
  this->filter_.setSearchMethod(pcl::make_shared<pcl::search::OrganizedNeighbor<PointT>>());
  EXPECT_THROW(this->run(cloud), pcl::BadArgumentException);
  this->filter_.setSearchMethod({});
  EXPECT_TRUE(sameBits(this->run(cloud), expected));
}

TYPED_TEST(FilterContract, CopiesAreIndependent)
{
  USING_FIXTURE;
  const CloudPtr cloud = this->noisyCube();
  this->makeNonFinite((*cloud)[7]);
  this->run(cloud);
  TypeParam copy = this->filter_;
  copy.setInputCloud(this->noisyCube());
  Cloud output;
  copy.filter(output);
  EXPECT_TRUE(copy.getRemovedIndices()->empty());
  EXPECT_EQ(*this->filter_.getRemovedIndices(), pcl::Indices{7});
}

} // namespace pcl_gpf::test
