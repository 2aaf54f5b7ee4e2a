// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../sorted_points.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Every stride-th point of a filtered cloud: where patches are looked at. */
struct Probes {
  Probes(const SoaBuffer& positions, const SoaBuffer& directions, std::size_t stride);

  PointsView view() const { return {points.x.data(), points.y.data(), points.z.data(), size}; }

  std::size_t size;
  SortedVectors<float> points, normals;
};

/** Sums of two fields over the data in the balls about the probes. */
struct FieldTotals {
  explicit FieldTotals(std::size_t padded) : count(padded), weight(padded), first(padded), second(padded) {}

  AlignedArray<float> count, weight, first, second;
};

/** Balls about the probes, whose neighbours are found once. */
class Balls {
public:
  /** \param[in] data followed by a padded element that is far away */
  Balls(const Probes& probes, PointsView data, double radius, std::size_t threads);

  /** Lets data weigh as much as their normals agree with the probe's, whatever their signs; the first field is one along these normals. */
  void
  weigh(const SoaBuffer& normals);

  FieldTotals
  sum(const AlignedArray<float>& first, const AlignedArray<float>& second) const;

private:
  const Probes& probes_;
  std::size_t threads_;
  Neighborhoods near_;
  kernels::FieldSums fields_;
};

/** Heights of the noisy points above the filtered surface, averaged over a patch about each probe. */
struct HeightPatches {
  std::vector<std::uint8_t> one_face;                    ///< 0: reaches across an edge
  std::vector<float> count;                              ///< of the points
  std::vector<float> data, mean, mean_size, mean_square; ///< sum of weights; of heights, of their sizes and of their squares
};

/** \param[in] noisy sorted points \param[in] positions, normals of the filtered surface, in that order; the positions are used up
 * \param[in] radius of a patch \param[in] with_sizes false: mean_size stays empty, in half the time */
HeightPatches
averageHeights(PointsView noisy, SoaBuffer positions, const SoaBuffer& normals, double noise, double radius, const Probes& probes,
               std::size_t threads, bool with_sizes = true);

} // namespace pcl_gpf
