// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/common/search_adapter.h>
#include <pcl_gpf/core/errors.h>

#include <gtest/gtest.h>

#include <pcl/exceptions.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace pcl_gpf::test {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;
using SearchPtr = pcl::search::Search<PointT>::Ptr;

double
pairDistance(PointsView a, std::size_t i, PointsView b, std::size_t j)
{
  return std::hypot(static_cast<double>(a.x[i]) - b.x[j], static_cast<double>(a.y[i]) - b.y[j],
                    static_cast<double>(a.z[i]) - b.z[j]);
}

class SearchAdapter : public ::testing::TestWithParam<SearchPtr> {
protected:
  SearchAdapter()
  {
    const Cloud::Ptr cloud = toCloud<PointT>(cube(1500, 0.01), 200, {1e5, 0, 0});
    pcl::Indices indices(cloud->size());
    std::iota(indices.begin(), indices.end(), 0);
    packed_ = pack(*cloud, indices);
  }

  PackedCloud packed_;
};

TEST_P(SearchAdapter, FindsEveryPairWithinTheRadiusAndHardlyMore)
{
  constexpr double kRadius = 0.08;
  const NeighborSearch search = adaptSearch<PointT>(GetParam(), packed_.frame, 2);
  const PointsView data = packed_.points.view();
  const PointsView queries{data.x + 3, data.y + 3, data.z + 3, 200};
  const NeighborLists lists = search(data, queries, kRadius);
  ASSERT_EQ(lists.offsets.size(), queries.size + 1);
  EXPECT_EQ(lists.offsets.front(), 0u);
  EXPECT_EQ(lists.offsets.back(), lists.indices.size());
  for (std::size_t q = 0; q < queries.size; ++q) {
    const auto begin = lists.indices.begin() + static_cast<std::ptrdiff_t>(lists.offsets[q]);
    const auto end = lists.indices.begin() + static_cast<std::ptrdiff_t>(lists.offsets[q + 1]);
    EXPECT_TRUE(std::is_sorted(begin, end));
    for (std::size_t n = 0; n < data.size; ++n) {
      const double r = pairDistance(queries, q, data, n);
      const bool found = std::binary_search(begin, end, static_cast<std::uint32_t>(n));
      EXPECT_TRUE(found || r > kRadius) << q << " misses " << n << " at " << r;
      EXPECT_TRUE(!found || r < 1.001 * kRadius);
    }
  }
}

TEST_P(SearchAdapter, TakesPointsAtExactlyTheRadiusIn)
{
  SoaBuffer data(3);
  data.x[1] = 0.25f;
  data.y[2] = 0.25f;
  LocalFrame frame;
  frame.scale = 10;
  const NeighborLists lists = adaptSearch<PointT>(GetParam(), frame, 1)(data.view(), data.view(), 0.25);
  EXPECT_EQ(lists.offsets, (std::vector<std::size_t>{0, 3, 5, 7}));
}

TEST_P(SearchAdapter, EmptyDataAndEmptyQueries)
{
  const NeighborSearch search = adaptSearch<PointT>(GetParam(), packed_.frame, 1);
  const NeighborLists no_data = search(PointsView(), packed_.points.view(), 0.1);
  EXPECT_EQ(no_data.offsets, std::vector<std::size_t>(packed_.size() + 1, 0));
  EXPECT_TRUE(no_data.indices.empty());
  EXPECT_EQ(search(packed_.points.view(), PointsView(), 0.1).offsets, std::vector<std::size_t>{0});
}

INSTANTIATE_TEST_SUITE_P(Searches,
                         SearchAdapter,
                         ::testing::Values(SearchPtr(new pcl::search::KdTree<PointT>(false)),
                                           SearchPtr(new pcl::search::KdTree<PointT>(true)),
                                           SearchPtr(new pcl::search::Octree<PointT>(10)),
                                           SearchPtr(new pcl::search::BruteForce<PointT>)));

TEST(SearchAdapterLimits, NoSearchMeansTheBuiltInOne)
{
  EXPECT_FALSE(adaptSearch<PointT>(SearchPtr(), LocalFrame(), 1));
}

TEST(SearchAdapterLimits, RefusesWhatCannotWork)
{
  EXPECT_THROW(checkSearchMethod("OrganizedNeighbor", LocalFrame()), InvalidParameter);
  LocalFrame frame;
  checkSearchMethod("KdTree", frame);
  for (const double scale : {1e-20, 1e20}) {
    frame.scale = scale;
    EXPECT_THROW(checkSearchMethod("KdTree", frame), InvalidParameter);
  }
}

TEST(SearchAdapterLimits, RowsAreTheSameForAnyNumberOfThreads)
{
  const RowSearch divisors = [](std::size_t query, std::vector<std::uint32_t>& row) {
    row.clear();
    for (std::uint32_t d = 20; d > 0; --d)
      if ((query + 1) % d == 0)
        row.push_back(d);
  };
  const NeighborLists expected = collectRows(3000, 1, divisors);
  const std::vector<std::uint32_t> first(expected.indices.begin(), expected.indices.begin() + 3);
  EXPECT_EQ(first, (std::vector<std::uint32_t>{1, 1, 2})) << "each row ascends";
  for (const std::size_t threads : {2u, 3u, 7u}) {
    const NeighborLists lists = collectRows(3000, threads, divisors);
    EXPECT_EQ(lists.offsets, expected.offsets);
    EXPECT_EQ(lists.indices, expected.indices);
  }
}

TEST(SearchAdapterLimits, ExcessivePairsThrowInsteadOfFillingTheMemory)
{
  const RowSearch ten = [](std::size_t, std::vector<std::uint32_t>& row) { row.assign(10, 0u); };
  EXPECT_EQ(collectRows(5000, 2, ten, 50000).indices.size(), 50000u);
  EXPECT_THROW(collectRows(5001, 2, ten, 50000), ExcessiveWork);
}

template <typename Core, typename Pcl>
std::string
translated(const std::string& message)
{
  try {
    try {
      throw Core(message);
    }
    catch (...) {
      rethrowAsPclException("GPF");
    }
  }
  catch (const Pcl& error) {
    return error.what();
  }
}

TEST(Exceptions, CoreErrorsBecomePclExceptionsAndOthersPass)
{
  EXPECT_EQ((translated<InvalidParameter, pcl::BadArgumentException>("h = -1")), "pcl_gpf : GPF: h = -1");
  EXPECT_EQ((translated<UnsuitableData, pcl::ComputeFailedException>("flat")), "pcl_gpf : GPF: flat");
  EXPECT_EQ((translated<ExcessiveWork, pcl::ComputeFailedException>("years")), "pcl_gpf : GPF: years");
  EXPECT_EQ((translated<std::logic_error, std::logic_error>("other")), "other");
}

} // namespace
} // namespace pcl_gpf::test
