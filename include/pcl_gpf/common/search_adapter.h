// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/views.h>

#include <pcl/search/search.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Writes the neighbours of one query into its argument; called by several threads at once. */
using RowSearch = std::function<void(std::size_t query, std::vector<std::uint32_t>& row)>;

/** \brief Most pairs that collectRows() keeps: 4 GiB of indices. */
constexpr std::size_t kMaximumPairs = std::size_t{1} << 30;

/** \brief Collects the rows of all queries, each sorted ascending. \throws ExcessiveWork beyond `maximum_pairs` */
PCL_GPF_EXPORT NeighborLists
collectRows(std::size_t queries,
            std::size_t threads,
            const RowSearch& search,
            std::size_t maximum_pairs = kMaximumPairs);

/** \brief Radius to ask a pcl::search::Search for, cloud units: a hair more than wanted, because FLANN leaves points at
 * exactly the radius out and works in float; the core tests the distance again. */
PCL_GPF_EXPORT double
widenedRadius(const LocalFrame& frame, double radius);

/** \brief Checks that a search can work for us: any that takes unorganised clouds, on extents whose square fits a
 * float.
 * \throws InvalidParameter */
PCL_GPF_EXPORT void
checkSearchMethod(const std::string& search_name, const LocalFrame& frame);

namespace detail {

/** \brief Positions in cloud units about the box centre: sizes that a search was set up for stay right, and no digit is
 * lost. */
template <typename PointT> void
setCentredPosition(const LocalFrame& frame, PointsView points, std::size_t i, PointT& point)
{
  point.x = static_cast<float>(frame.lengthToWorld(static_cast<double>(points.x[i])));
  point.y = static_cast<float>(frame.lengthToWorld(static_cast<double>(points.y[i])));
  point.z = static_cast<float>(frame.lengthToWorld(static_cast<double>(points.z[i])));
}

} // namespace detail

/** \brief A pcl::search::Search as the core's neighbour search; an empty function for a null pointer.
 *
 * The search gets clouds of finite points in cloud units about the box centre, a new one at every call, so its input
 * cloud is replaced and stays replaced. Its results may come in any order; its queries must be safe to run concurrently
 * (PCL's are).
 * \throws InvalidParameter if the search needs organised clouds
 */
template <typename PointT> NeighborSearch
adaptSearch(const typename pcl::search::Search<PointT>::Ptr& search, const LocalFrame& frame, std::size_t threads)
{
  if (!search)
    return {};
  checkSearchMethod(search->getName(), frame);
  return [=](PointsView data, PointsView queries, double radius) {
    typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
    cloud->resize(data.size);
    for (std::size_t i = 0; i < data.size; ++i)
      detail::setCentredPosition(frame, data, i, (*cloud)[i]);
    if (!cloud->empty()) // PCL's trees crash on queries after an empty cloud
      search->setInputCloud(cloud);
    const double widened = widenedRadius(frame, radius);
    return collectRows(queries.size, threads, [&](std::size_t query, std::vector<std::uint32_t>& row) {
      pcl::Indices indices;
      std::vector<float> squared_distances;
      PointT point;
      detail::setCentredPosition(frame, queries, query, point);
      if (!cloud->empty())
        search->radiusSearch(point, widened, indices, squared_distances);
      row.assign(indices.begin(), indices.end());
    });
  };
}

} // namespace pcl_gpf
