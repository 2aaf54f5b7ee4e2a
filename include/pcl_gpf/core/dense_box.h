// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/local_frame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pcl_gpf {

/** \brief Box of the dense part of a cloud: the whole box, unless 98 % of the points fill less than a thirtieth of it along an axis,
 * as when an outlier lies far away; then that axis is narrowed until they do not.
 *
 * The float grid of the normalised frame and the cells of the Hilbert curve are laid over this box, so that a far outlier costs the
 * rest of the cloud neither precision nor order. Does not depend on the order of the points. Cost: one pass, a few when it narrows.
 * \param[in] all box of all points, finite
 * \param[in] coordinate callable (index, axis) -> double
 */
template <typename Coordinate>
BoundingBox
denseBox(const BoundingBox& all, std::size_t count, const Coordinate& coordinate)
{
  constexpr std::size_t kBins = 256, kNarrow = 8;
  constexpr int kMostRounds = 16; // each narrows at least thirty-fold
  BoundingBox dense = all;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int round = 0; round < kMostRounds; ++round) {
      const double low = dense.min[axis], width = (dense.max[axis] - low) / kBins;
      if (!(width > 0.0))
        break;
      std::array<std::size_t, kBins> bins{};
      for (std::size_t i = 0; i < count; ++i)
        ++bins[static_cast<std::size_t>(std::clamp((coordinate(i, axis) - low) / width, 0.0, kBins - 1.0))];
      std::size_t first = 0, last = kBins - 1;
      for (std::size_t below = bins[first]; below * 100 < count; below += bins[++first]) {}
      for (std::size_t above = bins[last]; above * 100 < count; above += bins[--last]) {}
      if (last < first || last - first + 1 > kNarrow)
        break;
      dense.min[axis] = low + width * (static_cast<double>(first) - 1.0);
      dense.max[axis] = low + width * (static_cast<double>(last) + 2.0);
    }
  return dense;
}

/** \brief Refuses a cloud of which one point, garbage as a rule, lies so far away that the squared distances of all others are no
 * longer floats in the normalised frame; copies of one place and that point are fine.
 *
 * \param[in] all, dense boxes of all points and of their dense part \param[in] name callable index -> what the message calls the point
 * \throws UnsuitableData */
template <typename Coordinate, typename Name>
void
refuseFarPoint(const BoundingBox& all, const BoundingBox& dense, std::size_t count, const Coordinate& coordinate, const Name& name)
{
  constexpr double kWidestExtent = 1e15; // in units of the extent of the dense part
  if (!(all.diagonal() > kWidestExtent * dense.diagonal()))
    return;
  BoundingBox inside;
  std::size_t furthest = 0;
  double furthest_distance = -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double p[3] = {coordinate(i, 0), coordinate(i, 1), coordinate(i, 2)};
    if (dense.contains(p[0], p[1], p[2]))
      inside.add(p[0], p[1], p[2]);
    const double distance = std::hypot(p[0] - dense.min[0], p[1] - dense.min[1], p[2] - dense.min[2]);
    if (distance > furthest_distance) {
      furthest_distance = distance;
      furthest = i;
    }
  }
  if (inside.diagonal() > 0.0)
    throw UnsuitableData(name(furthest) + " lies so far away that the other points cannot be told apart; remove it, or write NaN "
                                          "where a coordinate is invalid");
}

} // namespace pcl_gpf
