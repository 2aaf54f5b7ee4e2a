// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/soa_buffer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** One of the widest gaps beside a point v, weighted by the edge that it lies across. */
struct Gap {
  std::array<float, 3> base{0.0f, 0.0f, 0.0f}; ///< b, the middle of v and t
  float clearance_sq = 0.0f;                   ///< C(b)
  float priority = 0.0f;                       ///< (2 - n_v.n_t)^rho C(b); 0 = there is no gap
  std::uint32_t partner = 0;                   ///< number of t
};

/** The widest gaps of a point that are kept: this many, one after another in arrays of gaps. */
constexpr std::size_t kGapsOfPoint = 2;

namespace kernels {

/** Steps of the table of (2 - c)^rho, over c from 1 down to -1. */
constexpr std::size_t kEdgeFactorSteps = 1024;

/** Between the entries of the table, which has two more than steps. */
inline float
edgeFactor(const float* factors, float cosine)
{
  const float step = std::clamp((1.0f - cosine) * (kEdgeFactorSteps / 2), 0.0f, static_cast<float>(kEdgeFactorSteps));
  const auto i = static_cast<std::size_t>(step);
  const float rest = step - static_cast<float>(i);
  return factors[i] + rest * (factors[i + 1] - factors[i]);
}

/** Positions, normals, and what names the points. */
struct PointRows {
  AlignedArray<float> x, y, z, nx, ny, nz;
  AlignedArray<std::uint32_t> number;

  PointRows() = default;
  explicit PointRows(std::size_t size) : x(size), y(size), z(size), nx(size), ny(size), nz(size), number(size) {}
};

/** Memory that a thread uses again for each patch. */
struct GapScratch {
  /** Neighbours beyond this many, the nearest ones, are left out, so that dense places cost no more than others. */
  static constexpr std::size_t kMostNeighbors = 95;

  PointRows candidates;                  ///< of the patch, relative to its middle
  AlignedArray<std::uint32_t> neighbors; ///< of one point, places among the candidates
  PointRows bases;                       ///< half-way to the neighbours, with their normals
  AlignedArray<float> clearance_sq, cosine, priority; ///< of the bases

  /** \param[in] candidates of a patch; a vector's width is added */
  void
  reserve(std::size_t count)
  {
    constexpr std::size_t kWidest = 32; // a vector may be written behind the last element, and read behind that
    if (clearance_sq.size() >= count + kWidest)
      return;
    const std::size_t size = 2 * (count + kWidest);
    for (PointRows* points : {&candidates, &bases})
      *points = PointRows(size);
    neighbors.assign(size);
    clearance_sq.assign(size);
    cosine.assign(size);
    priority.assign(size);
  }
};

/** Bases with their priorities, and what names the gaps. */
struct RivalRows {
  AlignedArray<float> x, y, z, priority;
  AlignedArray<std::uint32_t> number;

  RivalRows() = default;
  explicit RivalRows(std::size_t size) : x(size), y(size), z(size), priority(size), number(size) {}
};

/** Memory that a task uses again for each patch. */
struct RivalScratch {
  RivalRows wide;   ///< near the patch
  RivalRows narrow; ///< near a few gaps of it

  /** \param[in] count rivals of a patch; a vector's width is added */
  void
  reserve(std::size_t count)
  {
    constexpr std::size_t kWidest = 32;
    if (wide.number.size() >= count + kWidest)
      return;
    for (RivalRows* rows : {&wide, &narrow})
      *rows = RivalRows(2 * (count + kWidest));
  }
};

/** The squared radius of an open ball that holds at most kMostNeighbors of the neighbours of a point: as many, unless distances are
 * equal. */
inline float
radiusSqOfNearest(const GapScratch& scratch, std::size_t neighbors, const std::array<float, 3>& point)
{
  std::vector<float> distance_sq(neighbors);
  const PointRows& p = scratch.candidates;
  for (std::size_t k = 0; k < neighbors; ++k) {
    const std::size_t j = scratch.neighbors[k];
    const float x = p.x[j] - point[0], y = p.y[j] - point[1], z = p.z[j] - point[2];
    distance_sq[k] = x * x + y * y + z * z;
  }
  const auto first_left = distance_sq.begin() + static_cast<std::ptrdiff_t>(GapScratch::kMostNeighbors);
  std::nth_element(distance_sq.begin(), first_left, distance_sq.end());
  return *first_left;
}

} // namespace kernels
} // namespace pcl_gpf
