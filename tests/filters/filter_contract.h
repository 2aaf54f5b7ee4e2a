// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef PCL_GPF_TEST_CUSTOM_POINT
#include "filters/scanner_point.h"
#endif
#include "support/clouds.h"

#include <pcl_gpf/filters/bilateral_normal_filter.h>
#include <pcl_gpf/filters/gpf.h>
#include <pcl_gpf/filters/normal_orientation.h>
#include <pcl_gpf/filters/rimls_projection.h>

#include <gtest/gtest.h>

#include <string>

namespace pcl_gpf::test {

/** \brief What the contract suite must know of a filter; a new filter adds its own. */
template <typename FilterT>
struct ContractOf;

template <typename PointT>
struct ContractOf<GPF<PointT>> {
  using Point = PointT;
  static constexpr const char* kName = "GPF";
  static constexpr bool kKeepsNonFinite = false; ///< in an unorganised cloud
  static void prepare(GPF<PointT>& filter) { filter.setSupportRadius(0.3); }
  static void setInvalidParameter(GPF<PointT>& filter) { filter.setSupportRadius(-1); }
};

template <typename PointT>
struct ContractOf<BilateralNormalFilter<PointT>> {
  using Point = PointT;
  static constexpr const char* kName = "BilateralNormalFilter";
  static constexpr bool kKeepsNonFinite = true;
  static void prepare(BilateralNormalFilter<PointT>& filter) { filter.setRadius(0.2); }
  static void setInvalidParameter(BilateralNormalFilter<PointT>& filter) { filter.setRadius(-1); }
};

template <typename PointT>
struct ContractOf<RIMLSProjection<PointT>> {
  using Point = PointT;
  static constexpr const char* kName = "RIMLSProjection";
  static constexpr bool kKeepsNonFinite = false;
  static void prepare(RIMLSProjection<PointT>& filter) { filter.setSupportRadius(0.3); }
  static void setInvalidParameter(RIMLSProjection<PointT>& filter) { filter.setSupportRadius(-1); }
};

template <typename PointT>
struct ContractOf<NormalOrientation<PointT>> {
  using Point = PointT;
  static constexpr const char* kName = "NormalOrientation";
  static constexpr bool kKeepsNonFinite = true;
  static void prepare(NormalOrientation<PointT>& filter) { filter.setNeighbors(10); }
  static void setInvalidParameter(NormalOrientation<PointT>& filter) { filter.setNeighbors(2); }
};

#ifdef PCL_GPF_TEST_CUSTOM_POINT
/** \brief Every filter with a point type of the user's own; the place to add a new filter. */
using ContractFilters = ::testing::Types<GPF<ScannerPoint>, BilateralNormalFilter<ScannerPoint>, NormalOrientation<ScannerPoint>,
                                         RIMLSProjection<ScannerPoint>>;
#else
/** \brief Every filter with every compiled point type; the place to add a new filter. */
using ContractFilters = ::testing::Types<GPF<pcl::PointNormal>,
                                         GPF<pcl::PointXYZRGBNormal>,
                                         GPF<pcl::PointXYZINormal>,
                                         BilateralNormalFilter<pcl::PointNormal>,
                                         BilateralNormalFilter<pcl::PointXYZRGBNormal>,
                                         BilateralNormalFilter<pcl::PointXYZINormal>,
                                         NormalOrientation<pcl::PointNormal>,
                                         NormalOrientation<pcl::PointXYZRGBNormal>,
                                         NormalOrientation<pcl::PointXYZINormal>,
                                         RIMLSProjection<pcl::PointNormal>,
                                         RIMLSProjection<pcl::PointXYZRGBNormal>,
                                         RIMLSProjection<pcl::PointXYZINormal>>;
#endif

/** \brief A filter made ready for clouds of the size of the unit cube, and clouds for it. */
template <typename FilterT>
class FilterContract : public ::testing::Test {
protected:
  using FixturePoint = typename ContractOf<FilterT>::Point;
  using FixtureCloud = pcl::PointCloud<FixturePoint>;
  using FixtureCloudPtr = typename FixtureCloud::Ptr;

  static constexpr std::size_t kCount = 400;

  FilterContract() : filter_(true) { ContractOf<FilterT>::prepare(filter_); }

  static FixtureCloudPtr
  noisyCube(std::size_t count = kCount)
  {
    FixtureCloudPtr cloud = toCloud<FixturePoint>(cube(count, 0.01));
    for (std::size_t i = 0; i < count; ++i) // normals with something to filter
      (*cloud)[i].normal_x += 0.05f * static_cast<float>(i % 5);
    return cloud;
  }

  /** \brief 20 columns; positions and normals of noisyCube(). */
  static FixtureCloudPtr
  organisedCube()
  {
    FixtureCloudPtr cloud = noisyCube();
    cloud->width = 20;
    cloud->height = kCount / 20;
    return cloud;
  }

  static void
  makeNonFinite(FixturePoint& point)
  {
    point.y = kNaN;
  }

  /** \brief Runs the filter on a cloud. */
  FixtureCloud
  run(const FixtureCloudPtr& cloud)
  {
    FixtureCloud output;
    filter_.setInputCloud(cloud);
    filter_.filter(output);
    return output;
  }

  /** \brief Whether size, width and height fit and is_dense is true to the points. */
  static bool
  wellFormed(const FixtureCloud& cloud)
  {
    bool dense = true;
    for (const FixturePoint& point : cloud)
      dense = dense && pcl::isXYZFinite(point) && pcl::isNormalFinite(point);
    return std::size_t{cloud.width} * cloud.height == cloud.size() && cloud.is_dense == dense;
  }

  FilterT filter_;
};

TYPED_TEST_SUITE(FilterContract, ContractFilters);

} // namespace pcl_gpf::test
