// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "neighborhoods.h"

#include <utility>

namespace pcl_gpf {

/** Candidates that stay valid while points move less than a slack. */
class MovingNeighborhoods {
public:
  /** \param[in] moving_sides 1 if only queries or only data move, 2 if both do */
  MovingNeighborhoods(double radius, double moving_sides) : radius_(radius), moving_sides_(moving_sides) {}

  bool stale() const { return !built_ || moving_sides_ * moved_ > slack(); }
  double reach() const { return radius_ + slack(); }
  void
  set(Neighborhoods neighborhoods)
  {
    neighborhoods_ = std::move(neighborhoods);
    built_ = true;
    moved_ = 0.0;
  }
  void
  release()
  {
    neighborhoods_ = {};
    built_ = false;
  }
  void addMovement(double longest) { moved_ += longest; }
  const Neighborhoods& get() const { return neighborhoods_; }

private:
  /** A tenth of the radius: about 20 % more candidates against lists built anew in every iteration. */
  double slack() const { return 0.1 * radius_; }

  double radius_;
  double moving_sides_;
  double moved_ = 0.0;
  bool built_ = false;
  Neighborhoods neighborhoods_;
};

} // namespace pcl_gpf
