// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** A point of a filtered cloud with its normal, whose sign is free. */
struct FacePoint {
  std::array<float, 3> position, normal;
  std::uint32_t place; ///< in the sorted order of the cloud
};

/** The points near `center` that face as `normal` does, and the others; positions relative to `center`. */
struct FaceView {
  std::array<float, 3> center, normal;
  std::vector<FacePoint> own, other;
};

/** A sharp edge between the face and another, about as seen from the centre. */
struct FaceEdge {
  std::array<float, 3> inward{};                    ///< unit vector in the tangent plane, square to the edge, away from it
  double distance = 0;                              ///< of the centre from the edge, negative beyond it
  double nearest_other = 0;                         ///< distance of the nearest point of the other face from the centre
  bool found = false;

  /** Of a position relative to the centre. */
  double
  distanceOf(const std::array<float, 3>& offset) const
  {
    return distance + static_cast<double>(offset[0] * inward[0] + offset[1] * inward[1] + offset[2] * inward[2]);
  }
};

/** \brief The line in which the tangent plane at the centre meets the mean plane of the nearest other face.
 * \param[in] reach radius of the ball that the view covers \param[in] least_cosine of normals on one face
 * \return not found where there is no other face, or where the own one lies on both sides of the line */
FaceEdge
nearestEdge(const FaceView& view, float reach, float least_cosine);

} // namespace pcl_gpf
