// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_gpf {

/** \brief N three-dimensional vectors in structure-of-arrays form; does not own them.
 *
 * Each pointer addresses `size` floats. No alignment is required. Valid as long as the storage behind it.
 */
struct VectorsView {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t size = 0;
};

/** \brief Positions in the frame that the function at hand names. */
using PointsView = VectorsView;

/** \brief Unit normals, one per point of the PointsView beside it. The sign is free unless a function says otherwise. */
using NormalsView = VectorsView;

/** \brief N three-dimensional vectors that a function writes. */
struct MutableVectorsView {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  std::size_t size = 0;

  operator VectorsView() const { return {x, y, z, size}; }
};

} // namespace pcl_gpf
