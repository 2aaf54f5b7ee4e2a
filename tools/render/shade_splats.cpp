// SPDX-License-Identifier: BSD-3-Clause
#include "splats.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kRowsPerBlock = 16;

/** Brightness of a surface with a unit normal turned to the viewer. */
float
brightness(const Position& normal, const Camera& camera)
{
  const double facing = dot(normal, camera.view.toward);
  const double sign = facing < 0 ? -1 : 1;
  const Position seen{sign * dot(normal, camera.view.right), sign * dot(normal, camera.view.up), sign * facing};
  const double key = dot(seen, normalized({-0.45, 0.6, 0.75}));
  const double fill = dot(seen, normalized({0.9, -0.1, 0.4}));
  return static_cast<float>(0.36 + 0.56 * std::max(key, 0.0) + 0.22 * std::max(fill, 0.0));
}

/** How much of the light reaches a pixel that others stand in front of (eye-dome lighting: Boucheny 2009). */
float
openness(const VisibleSplats& visible, std::size_t column, std::size_t row)
{
  constexpr std::ptrdiff_t kReach = 3;      // pixels
  constexpr float kStep = 6.0f * kReach;    // a step in depth that counts in full
  constexpr std::ptrdiff_t kDirections[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  const float depth = visible.depth[row * visible.width + column];
  float hidden = 0;
  for (const auto& direction : kDirections) {
    const auto x = static_cast<std::ptrdiff_t>(column) + kReach * direction[0];
    const auto y = static_cast<std::ptrdiff_t>(row) + kReach * direction[1];
    if (x < 0 || y < 0 || x >= static_cast<std::ptrdiff_t>(visible.width) || y >= static_cast<std::ptrdiff_t>(visible.height))
      continue;
    const float rise = visible.depth[static_cast<std::size_t>(y) * visible.width + static_cast<std::size_t>(x)] - depth;
    hidden += std::clamp((rise - 1.5f * kReach) / kStep, 0.0f, 1.0f);
  }
  return 1.0f - 0.55f * std::min(hidden / 4, 1.0f);
}

} // namespace

Image
shadeSplats(const SplatCloud& cloud, const VisibleSplats& visible, const Camera& camera, Color background, std::size_t threads)
{
  Image image(visible.width, visible.height, background);
  parallelBlocks(visible.height, kRowsPerBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (std::size_t column = 0; column < visible.width; ++column) {
        const std::uint32_t point = visible.point[row * visible.width + column];
        if (point == VisibleSplats::kNothing)
          continue;
        const float lit = cloud.lit && !cloud.normals.empty() ? brightness(cloud.normals[point], camera) : 1.0f;
        const float light = lit * openness(visible, column, row);
        for (std::size_t channel = 0; channel < 3; ++channel)
          image.at(column, row)[channel] = std::min(1.0f, light * cloud.colors[point][channel]);
      }
  });
  return image;
}

} // namespace pcl_gpf
