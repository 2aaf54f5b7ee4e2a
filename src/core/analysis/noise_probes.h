// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_patch.h"
#include "thinned_clouds.h"

#include <pcl_gpf/core/point_index.h>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl_gpf {

/** \brief What patches tell. */
struct NoiseReading {
  double noise = std::numeric_limits<double>::infinity(); ///< standard deviation along the normal; infinite: no patch
  double kurtosis = 0.0;                                  ///< of the heights, which are trimmed
  double trimmed = 0.0;                                   ///< share of the points further away than the trim
};

/** \brief Patches of a cloud, even over its surface, of any width. */
class NoiseProbes {
public:
  using Center = std::array<float, 3>;
  using Centers = std::vector<Center>;

  /** Fewest points that tell a noise; where it is below the spacing a patch is of so many nearest points. */
  static constexpr std::size_t kNearest = 48;
  /** Every so many centres find the scale; all of them measure it. */
  static constexpr std::size_t kCoarseStep = 3;

  /** \param[in] points must outlive this object */
  NoiseProbes(const PointIndex& points, std::size_t threads) : points_(points), thinned_(points, threads), threads_(threads) {}

  /** \brief Places of patches, on points. */
  Centers
  evenCenters() const;

  /** \brief Noise in patches as wide as a `guess` at it asks for, infinite: in those of the nearest points; a low quantile over patches,
   * 0 where there are none. Their shape is a mean over the lower half. Every `step`th of the centres moves onto its surface. */
  NoiseReading
  measure(Centers& centers, double guess, std::size_t step) const;

private:
  struct Scratch;
  NoiseReading
  measureAt(Center& center, double guess, Scratch& scratch) const;
  /** \return false if the ball holds too few points or those of a line */
  bool
  fitBall(const Center& center, double guess, Scratch& scratch, SurfacePatch& patch) const;
  /** The nearest points within the widest radius. \return the radius that they fill */
  double
  widen(const Center& center, double guess, Scratch& scratch) const;
  SurfacePatch
  fitNearest(const Center& center, double guess, Scratch& scratch) const;

  const PointIndex& points_;
  const ThinnedClouds thinned_;
  const std::size_t threads_;
};

} // namespace pcl_gpf
