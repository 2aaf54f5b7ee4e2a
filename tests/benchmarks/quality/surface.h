// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "curves.h"

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/local_frame.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf::quality {

/** \brief A point of a surface; `part` numbers the patch or triangle it was drawn from. */
struct SurfaceSample {
  Position point, normal;
  std::uint32_t part = 0;
};

/** \brief What the surface is like where it is nearest to a query. */
struct SurfaceHit {
  double signed_distance = 0; ///< above 0 outside, or on the side of the normal
  Position normal{0, 0, 1};   ///< of the nearest part
  std::uint32_t part = 0;
};

/** \brief The truth that clouds are drawn from and measured against. Queries are const and may run concurrently. */
class Surface {
public:
  virtual ~Surface() = default;

  virtual BoundingBox
  box() const = 0;
  virtual double
  area() const = 0;
  /** \brief Whether inside and outside exist everywhere, so that a signed mean means shrinkage or inflation. */
  virtual bool
  closed() const = 0;
  /** \brief `count` points drawn evenly by area in random order, repeatable by `seed`. */
  virtual std::vector<SurfaceSample>
  sample(std::size_t count, std::uint64_t seed) const = 0;
  virtual SurfaceHit
  nearest(const Position& p) const = 0;
  /** \brief Distance to the nearest sharp edge; infinite without edges. */
  virtual double
  edgeDistance(const Position& p) const = 0;
  /** \brief Points on the sharp edges, `step` apart; none without edges. */
  virtual std::vector<Position>
  edgeSamples(double step) const = 0;
  /** \brief Distance to the boundary of an open surface; infinite when closed. */
  virtual double
  boundaryDistance(const Position& p) const = 0;
  virtual std::vector<BoundarySample>
  boundarySamples(double step) const = 0;

  /** \brief Length of the bounding box's diagonal; errors are given in 1e-4 of it. */
  double
  diagonal() const
  {
    return box().diagonal();
  }
};

} // namespace pcl_gpf::quality
