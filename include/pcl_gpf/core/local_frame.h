// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

#include <array>
#include <cstddef>

namespace pcl_gpf {

/** \brief The normalised frame in which all of the core computes: centre of the bounding box at 0, box diagonal 1.
 *
 * local = (world - origin) / scale, evaluated in double and only then rounded to float. This keeps millimetres of a cloud in UTM
 * coordinates and makes sigma^2 = 0.004 and every tolerance free of units (paper, Algorithm 1).
 */
struct LocalFrame {
  std::array<double, 3> origin{0.0, 0.0, 0.0}; ///< centre of the bounding box, or of its dense part, world units
  double scale = 1.0;                          ///< length of the box diagonal, world units, > 0

  float toLocal(double world, std::size_t axis) const { return static_cast<float>((world - origin[axis]) / scale); }
  double toWorld(float local, std::size_t axis) const { return static_cast<double>(local) * scale + origin[axis]; }
  /** \brief A length in world units to the normalised frame. */
  double lengthToLocal(double length) const { return length / scale; }
  /** \brief A length in the normalised frame to world units. */
  double lengthToWorld(double length) const { return length * scale; }
};

/** \brief Bounding box of points added one by one. */
struct BoundingBox {
  std::array<double, 3> min{0, 0, 0};
  std::array<double, 3> max{0, 0, 0};
  std::size_t count = 0; ///< points added

  void
  add(double x, double y, double z)
  {
    const std::array<double, 3> p{x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = count == 0 || p[axis] < min[axis] ? p[axis] : min[axis];
      max[axis] = count == 0 || p[axis] > max[axis] ? p[axis] : max[axis];
    }
    ++count;
  }
  /** \brief Whether a point lies in the box or on its surface. */
  bool
  contains(double x, double y, double z) const
  {
    return x >= min[0] && y >= min[1] && z >= min[2] && x <= max[0] && y <= max[1] && z <= max[2];
  }
  /** \brief Length of the diagonal; 0 when empty or all points coincide; overflow-free for finite boxes. */
  PCL_GPF_CORE_EXPORT double
  diagonal() const;
};

/** \brief Frame of a box. \return scale 1 if the diagonal is 0, so that degenerate data map to the origin. */
PCL_GPF_CORE_EXPORT LocalFrame
localFrame(const BoundingBox& box);

/** \brief The same scale with the origin in the middle of the dense part (denseBox()), near which floats are finest. */
PCL_GPF_CORE_EXPORT LocalFrame
localFrame(const BoundingBox& box, const BoundingBox& dense);

} // namespace pcl_gpf
