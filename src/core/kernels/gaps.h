// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/soa_buffer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
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
  void
  set(std::size_t k, const std::array<float, 3>& position, const std::array<float, 3>& normal, std::uint32_t name)
  {
    x[k] = position[0];
    y[k] = position[1];
    z[k] = position[2];
    nx[k] = normal[0];
    ny[k] = normal[1];
    nz[k] = normal[2];
    number[k] = name;
  }
};

/** Memory that a thread uses again for each patch. */
struct GapScratch {
  /** Neighbours beyond this many, the nearest ones, are left out, so that dense places cost no more than others. */
  static constexpr std::size_t kMostNeighbors = 95;

  PointRows candidates; ///< of the patch
  PointRows neighbors;  ///< of one point, relative to it
  PointRows bases;      ///< half-way to the neighbours, with their normals
  AlignedArray<float> clearance_sq, cosine, priority; ///< of the bases

  /** \param[in] candidates of a patch; a vector's width is added */
  void
  reserve(std::size_t count)
  {
    constexpr std::size_t kWidest = 32; // a vector may be written behind the last element, and read behind that
    if (clearance_sq.size() >= count + kWidest)
      return;
    const std::size_t size = 2 * (count + kWidest);
    for (PointRows* points : {&candidates, &neighbors, &bases})
      *points = PointRows(size);
    clearance_sq.assign(size);
    cosine.assign(size);
    priority.assign(size);
  }
};

/** Leaves the nearest of `count` neighbours, in the order that they have. \return how many */
inline std::size_t
keepNearest(PointRows& neighbors, std::size_t count)
{
  std::vector<float> distance_sq(count);
  for (std::size_t j = 0; j < count; ++j)
    distance_sq[j] = neighbors.x[j] * neighbors.x[j] + neighbors.y[j] * neighbors.y[j] + neighbors.z[j] * neighbors.z[j];
  std::vector<std::uint32_t> nearest(count);
  std::iota(nearest.begin(), nearest.end(), 0u);
  const auto end = nearest.begin() + static_cast<std::ptrdiff_t>(GapScratch::kMostNeighbors);
  std::nth_element(nearest.begin(), end, nearest.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance_sq[a] < distance_sq[b] || (distance_sq[a] == distance_sq[b] && a < b);
  });
  std::sort(nearest.begin(), end);
  for (std::size_t k = 0; k < GapScratch::kMostNeighbors; ++k) {
    const std::uint32_t j = nearest[k];
    for (AlignedArray<float>* values : {&neighbors.x, &neighbors.y, &neighbors.z, &neighbors.nx, &neighbors.ny, &neighbors.nz})
      (*values)[k] = (*values)[j];
    neighbors.number[k] = neighbors.number[j];
  }
  return GapScratch::kMostNeighbors;
}

} // namespace kernels
} // namespace pcl_gpf
