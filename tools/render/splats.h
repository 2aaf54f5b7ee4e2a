// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "camera.h"
#include "image.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_gpf {

/** \brief Points as discs of one radius. */
struct SplatCloud {
  std::vector<Position> points;  ///< finite
  std::vector<Position> normals; ///< unit, one per point, of any sign; empty: the discs face the viewer
  std::vector<Color> colors;     ///< one per point
  double radius = 0;             ///< in the unit of the points
  bool lit = true;               ///< light depends on the normals; false: the colours are shown as they are
};

/** \brief Per pixel the disc that is seen there. */
struct VisibleSplats {
  static constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint32_t> point; ///< kNothing where the background shows
  std::vector<float> depth;         ///< pixels towards the viewer
};

/** \brief Draws the discs with a depth buffer. Discs get a radius of 0.75 pixels at least, so that no point is lost.
 *
 * Discs that are seen almost edge-on are drawn as if tilted by 80 degrees. The result does not depend on the threads.
 */
VisibleSplats
drawSplats(const SplatCloud& cloud, const Camera& camera, std::size_t threads);

/** \brief Draws triangles over the points the same way; a pixel belongs to its nearest corner. The result does not depend on the threads.
 * \param[in] triangles three point numbers each */
VisibleSplats
drawTriangles(const std::vector<Position>& points, const std::vector<std::uint32_t>& triangles, const Camera& camera, std::size_t threads);

/** \brief Colours the pixels: light from over the viewer's left shoulder, and darkness behind edges in depth. */
Image
shadeSplats(const SplatCloud& cloud, const VisibleSplats& visible, const Camera& camera, Color background, std::size_t threads);

} // namespace pcl_gpf
