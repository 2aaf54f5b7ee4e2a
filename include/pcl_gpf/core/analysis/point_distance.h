// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/export.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** \brief Exact distances to the nearest point of a cloud, in double precision. For measuring; the filters have a faster search.
 *
 * Build O(N log N), a query O(log N) on typical data; about 90 bytes a point. Copies share the tree.
 * Thread safety: all queries are const and may run concurrently.
 */
class PCL_GPF_CORE_EXPORT PointDistance {
public:
  /** \brief The nearest point. */
  struct Nearest {
    std::uint32_t index = 0; ///< row in the vector given to the constructor; of several at the same distance, always the same one
    double distance = 0;
  };

  /** \brief Takes the measurable points (isMeasurable()) of `points`. \throws UnsuitableData if there is none or more than 2^32 - 1 */
  explicit PointDistance(const std::vector<Position>& points);

  /** \brief Nearest point to a measurable `query`. */
  Nearest
  nearest(const Position& query) const;

  /** \brief Distance of every query; NaN for queries that are not measurable. The result does not depend on the threads (0 = all). */
  std::vector<double>
  distances(const std::vector<Position>& queries, unsigned number_of_threads = 0) const;

private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

} // namespace pcl_gpf
