// SPDX-License-Identifier: BSD-3-Clause
#include "splats.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kRowsPerStrip = 32;

struct Corner {
  float x, y, depth;
};

/** Rows [first, end) whose pixel centres a triangle may cover. */
std::array<std::size_t, 2>
rowsOf(const std::array<Corner, 3>& t, std::size_t height)
{
  const float low = std::min({t[0].y, t[1].y, t[2].y}), high = std::max({t[0].y, t[1].y, t[2].y});
  const auto clamped = [height](float row) { return static_cast<std::size_t>(std::clamp(row, 0.0f, static_cast<float>(height))); };
  return {clamped(std::ceil(low - 0.5f)), clamped(std::floor(high - 0.5f) + 1.0f)};
}

/** Draws the rows [first_row, end_row); a pixel belongs to the corner with the largest share in it. */
void
drawTriangle(const std::array<Corner, 3>& t, const std::uint32_t* numbers, std::size_t first_row, std::size_t end_row, VisibleSplats& target)
{
  const float area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (!(std::abs(area) > 0.0f))
    return;
  const std::array<std::size_t, 2> rows = rowsOf(t, target.height);
  const float left = std::min({t[0].x, t[1].x, t[2].x}), right = std::max({t[0].x, t[1].x, t[2].x});
  const auto width = static_cast<float>(target.width);
  const auto first = static_cast<std::size_t>(std::clamp(std::ceil(left - 0.5f), 0.0f, width));
  const auto end = static_cast<std::size_t>(std::clamp(std::floor(right - 0.5f) + 1.0f, 0.0f, width));
  for (std::size_t row = std::max(rows[0], first_row); row < std::min(rows[1], end_row); ++row)
    for (std::size_t column = first; column < end; ++column) {
      const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
      float share[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
        share[k] = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
      }
      if (share[0] < 0.0f || share[1] < 0.0f || share[2] < 0.0f)
        continue;
      const float depth = share[0] * t[0].depth + share[1] * t[1].depth + share[2] * t[2].depth;
      const std::size_t pixel = row * target.width + column;
      if (depth > target.depth[pixel]) {
        target.depth[pixel] = depth;
        target.point[pixel] = numbers[std::max_element(share, share + 3) - share];
      }
    }
}

} // namespace

VisibleSplats
drawTriangles(const std::vector<Position>& points, const std::vector<std::uint32_t>& triangles, const Camera& camera, std::size_t threads)
{
  std::vector<Corner> corners(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Position on_screen = camera.project(points[i]);
    corners[i] = {static_cast<float>(on_screen[0]), static_cast<float>(on_screen[1]), static_cast<float>(on_screen[2])};
  }
  const auto cornersOf = [&](std::size_t t) {
    return std::array<Corner, 3>{corners[triangles[t]], corners[triangles[t + 1]], corners[triangles[t + 2]]};
  };
  std::vector<std::vector<std::uint32_t>> strips((camera.height + kRowsPerStrip - 1) / kRowsPerStrip);
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const std::array<std::size_t, 2> rows = rowsOf(cornersOf(t), camera.height);
    for (std::size_t strip = rows[0] / kRowsPerStrip; strip * kRowsPerStrip < rows[1]; ++strip)
      strips[strip].push_back(static_cast<std::uint32_t>(t / 3));
  }
  VisibleSplats visible;
  visible.width = camera.width;
  visible.height = camera.height;
  visible.point.assign(camera.width * camera.height, VisibleSplats::kNothing);
  visible.depth.assign(camera.width * camera.height, -std::numeric_limits<float>::infinity());
  parallelBlocks(strips.size(), 1, threads, [&](std::size_t strip, std::size_t) {
    for (const std::uint32_t triangle : strips[strip])
      drawTriangle(cornersOf(3 * std::size_t{triangle}), triangles.data() + 3 * std::size_t{triangle}, strip * kRowsPerStrip,
                   std::min((strip + 1) * kRowsPerStrip, camera.height), visible);
  });
  return visible;
}

} // namespace pcl_gpf
