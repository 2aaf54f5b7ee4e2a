// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Points sorted along a Hilbert curve with the tree over them: made once, used by every operator on the same points.
 *
 * Functions that take a PointIndex work in *sorted order*: element k of a normal array belongs to sorted()[k], which is the caller's
 * point order()[k]. Memory: 16 bytes a point. Immutable after construction and safe to share between threads.
 */
class PCL_GPF_CORE_EXPORT PointIndex {
public:
  /** \param[in] points N finite positions, copied \param[in] number_of_threads 0 = all that the process may use */
  explicit PointIndex(PointsView points, unsigned number_of_threads = 0);

  std::size_t
  size() const
  {
    return order_.size();
  }
  /** \brief The caller's index of each sorted point. */
  const std::vector<std::uint32_t>&
  order() const
  {
    return order_;
  }
  /** \brief Positions in sorted order, followed by 16 padding positions far beyond any radius. */
  PointsView
  sorted() const
  {
    return {positions_.x.data(), positions_.y.data(), positions_.z.data(), size()};
  }
  const ClusterTree&
  tree() const
  {
    return tree_;
  }

private:
  std::vector<std::uint32_t> order_;
  SoaBuffer positions_;
  ClusterTree tree_;
};

} // namespace pcl_gpf
