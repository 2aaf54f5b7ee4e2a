// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/local_frame.h>

#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Axes of the picture in the space of the cloud: orthonormal, right-handed. */
struct View {
  Position right{1, 0, 0};
  Position up{0, 1, 0};
  Position toward{0, 0, 1}; ///< from the scene to the viewer
};

/** \brief A view from a direction. \param[in] toward from the scene to the viewer, not 0
 * \param[in] up what is up in the picture; another axis is taken where it is parallel to `toward` */
View
makeView(const Position& toward, const Position& up);

/** \brief The view when the user names none.
 *
 * From the sensor, a little aside, where it stands a quarter to 20 diagonals away from the box, with its usual up (-y when it looks
 * along z, y when along -z, else z); three quarters from above with z up for everything else.
 */
View
automaticView(const BoundingBox& box, const Position& sensor);

/** \brief Parallel projection: pixels to the right, pixels downwards, and pixels towards the viewer. */
struct Camera {
  View view;
  Position centre{0, 0, 0}; ///< shown in the middle
  double pixels_per_unit = 1;
  std::size_t width = 0;
  std::size_t height = 0;

  Position
  project(const Position& point) const
  {
    const Position offset = subtract(point, centre);
    return {0.5 * static_cast<double>(width) + pixels_per_unit * dot(offset, view.right),
            0.5 * static_cast<double>(height) - pixels_per_unit * dot(offset, view.up),
            pixels_per_unit * dot(offset, view.toward)};
  }
};

/** \brief Camera that shows all points but the outermost thousandth on each side and those far away from all others, with a margin.
 *
 * \param[in] points all finite, at least one
 */
Camera
fitCamera(const View& view, const std::vector<Position>& points, std::size_t width, std::size_t height);

} // namespace pcl_gpf
