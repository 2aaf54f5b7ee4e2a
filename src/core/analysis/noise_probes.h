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
  double level = 0.0;                                     ///< of one patch: the deviation as it is, the luck of the lowest not undone
  double reach = 0.0;                                     ///< of one patch: radius
};

/** \brief A low quantile of patches, and the mean shape over their lower half; 0 where there are none. */
NoiseReading
quietTenth(std::vector<NoiseReading> patches);

/** \brief A patch as wide as its own noise asks for. */
struct NoiseLevel {
  std::array<float, 3> center{};
  double noise = 0.0;    ///< 0: none was found
  double reach = 0.0;    ///< radius of the patch
  double kurtosis = 0.0; ///< of its heights, which are trimmed
};

/** \brief A patch and the heights of points about it. */
struct PatchHeights {
  SurfacePatch patch;
  std::vector<float> heights;
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

  /** \brief What patches show that are as wide as a `guess` at the noise asks for, infinite: those of the nearest points. Every `step`th
   * of the centres is read, in their order, and moves onto its surface. */
  std::vector<NoiseReading>
  readEach(Centers& centers, double guess, std::size_t step) const;
  NoiseReading
  measure(Centers& centers, double guess, std::size_t step) const
  {
    return quietTenth(readEach(centers, guess, step));
  }

  /** \brief Levels of patches that are each as wide as their own noise asks for; of every `step`th centre, from what all of them showed
   * at `guess` on. */
  std::vector<NoiseLevel>
  settleEach(const Centers& centers, const std::vector<NoiseReading>& at_guess, double guess, std::size_t step) const;

  /** \brief Wider patches of every `step`th centre with the heights of all points about them, in units of the guess and up to
   * kPooledHeight. */
  std::vector<PatchHeights>
  heightsOfEach(const Centers& centers, double guess, std::size_t step) const;

private:
  struct Scratch;
  NoiseLevel
  settleAt(Center center, NoiseReading reading, double guess, Scratch& scratch) const;
  PatchHeights
  heightsAt(const Center& center, double guess, Scratch& scratch) const;
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
