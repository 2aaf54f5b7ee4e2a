// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../kernels/gaps.h"
#include "../kernels/kernels.h"

#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/core/views.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Points of `points`, ascending, without copies: of those that lie where the one before them does, on the curve, those of one direction
 * leave one. So a pile of coincident points is a few points, and costs what they do.
 * \param[in] apart distances below are rounding \param[in] sign_invariant opposite normals are one direction */
std::vector<std::uint32_t>
placesWithoutCopies(PointsView points, NormalsView normals, float apart, bool sign_invariant);

/** Points in an order in which neighbours follow each other, to which points are added beside others: so nothing is sorted again.
 *
 * A point keeps its number, those of the input are their places in the PointIndex; its place in the order changes. */
class GrowingCloud {
public:
  /** \param[in] normals of unit length, in sorted order \param[in] places of the points that take part, ascending */
  GrowingCloud(const PointIndex& points, NormalsView normals, const std::vector<std::uint32_t>& places, std::size_t threads);

  std::size_t size() const { return size_; }
  /** Numbers that were given: to all of the input, and to those added. */
  std::uint32_t numberCount() const { return static_cast<std::uint32_t>(places_.size()); }
  kernels::Vectors<float> positions() const { return {rows_.x.data(), rows_.y.data(), rows_.z.data()}; }
  kernels::Vectors<float> normals() const { return {rows_.nx.data(), rows_.ny.data(), rows_.nz.data()}; }
  const std::uint32_t* numbers() const { return rows_.number.data(); }
  std::array<float, 3> position(std::size_t place) const { return {rows_.x[place], rows_.y[place], rows_.z[place]}; }
  std::array<float, 3> normal(std::size_t place) const { return {rows_.nx[place], rows_.ny[place], rows_.nz[place]}; }
  std::size_t placeOf(std::uint32_t number) const { return places_[number]; }
  const ClusterTree& tree() const { return tree_; }

  /** The gaps beside each point, kGapsOfPoint at a place. */
  std::vector<Gap>& gaps() { return gaps_; }
  const std::vector<Gap>& gaps() const { return gaps_; }

  /** Fills gaps: adds a point behind the place of each, whose gaps are as free as that was; numbers go on in their order.
   * \param[in] filled ascending indices of gaps */
  void
  insert(const std::vector<std::uint32_t>& filled, kernels::Vectors<float> positions, kernels::Vectors<float> normals);

private:
  template <class Array, class ValueOfNew>
  Array
  spread(const Array& from, std::size_t each, const std::vector<std::uint32_t>& filled, const ValueOfNew& value_of_new) const;

  std::size_t size_, threads_;
  kernels::PointRows rows_;
  std::vector<Gap> gaps_;
  std::vector<std::uint32_t> places_; ///< of each number
  ClusterTree tree_;
};

} // namespace pcl_gpf
