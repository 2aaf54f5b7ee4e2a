// SPDX-License-Identifier: BSD-3-Clause
#include "splats.h"

#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kRowsPerStrip = 32;
constexpr std::size_t kPointsPerBlock = 8192;
constexpr float kLeastRadius = 0.75f;
constexpr float kLeastFacing = 0.17f; // cosine of 80 degrees
constexpr float kDome = 0.3f;         // how much deeper the rim is, in radii: of discs in one plane the nearest shows

/** A disc on the screen: centre, depth, and how its depth changes per pixel. */
struct Disc {
  float x, y, depth;
  float slope_x, slope_y;
};

Disc
projectDisc(const SplatCloud& cloud, const Camera& camera, std::size_t i)
{
  const Position on_screen = camera.project(cloud.points[i]);
  Disc disc{static_cast<float>(on_screen[0]), static_cast<float>(on_screen[1]), static_cast<float>(on_screen[2]), 0, 0};
  if (cloud.normals.empty())
    return disc;
  const Position& normal = cloud.normals[i];
  const double facing = dot(normal, camera.view.toward);
  const double divisor = std::copysign(std::max(std::abs(facing), double{kLeastFacing}), facing);
  disc.slope_x = static_cast<float>(-dot(normal, camera.view.right) / divisor);
  disc.slope_y = static_cast<float>(dot(normal, camera.view.up) / divisor); // rows go downwards
  return disc;
}

/** Point numbers by strip of rows: those of strip s are points[begin[s]] .. points[begin[s + 1]], ascending. */
struct Strips {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> points;
};

template <class Visit>
void
forEachStrip(const Disc& disc, float radius, std::size_t width, std::size_t height, Visit&& visit)
{
  if (!(disc.x > -radius && disc.x < static_cast<float>(width) + radius))
    return;
  const float first = std::max(disc.y - radius, 0.0f);
  const float last = std::min(disc.y + radius, static_cast<float>(height) - 1.0f);
  if (!(first <= last))
    return;
  for (std::size_t strip = static_cast<std::size_t>(first) / kRowsPerStrip;
       strip <= static_cast<std::size_t>(last) / kRowsPerStrip; ++strip)
    visit(strip);
}

Strips
sortIntoStrips(const std::vector<Disc>& discs, float radius, std::size_t width, std::size_t height)
{
  Strips strips;
  strips.begin.assign((height + kRowsPerStrip - 1) / kRowsPerStrip + 1, 0);
  for (const Disc& disc : discs)
    forEachStrip(disc, radius, width, height, [&](std::size_t strip) { ++strips.begin[strip + 1]; });
  for (std::size_t strip = 1; strip < strips.begin.size(); ++strip)
    strips.begin[strip] += strips.begin[strip - 1];
  strips.points.resize(strips.begin.back());
  std::vector<std::size_t> next = strips.begin;
  for (std::size_t i = 0; i < discs.size(); ++i)
    forEachStrip(discs[i], radius, width, height,
                 [&](std::size_t strip) { strips.points[next[strip]++] = static_cast<std::uint32_t>(i); });
  return strips;
}

/** Draws the rows [first_row, end_row) of one disc. */
void
drawDisc(const Disc& disc, float radius, std::uint32_t number, std::size_t first_row, std::size_t end_row, VisibleSplats& target)
{
  const auto firstPixel = [&](float centre, std::size_t least) {
    return std::max(static_cast<std::ptrdiff_t>(std::ceil(centre - radius - 0.5f)), static_cast<std::ptrdiff_t>(least));
  };
  const auto endPixel = [&](float centre, std::size_t most) {
    return std::min(static_cast<std::ptrdiff_t>(std::floor(centre + radius - 0.5f)) + 1, static_cast<std::ptrdiff_t>(most));
  };
  for (std::ptrdiff_t row = firstPixel(disc.y, first_row); row < endPixel(disc.y, end_row); ++row)
    for (std::ptrdiff_t column = firstPixel(disc.x, 0); column < endPixel(disc.x, target.width); ++column) {
      const float dx = static_cast<float>(column) + 0.5f - disc.x;
      const float dy = static_cast<float>(row) + 0.5f - disc.y;
      const float rise = disc.slope_x * dx + disc.slope_y * dy;
      // A tilted disc may be thinner than a pixel: its middle always shows.
      const float flat_sq = dx * dx + dy * dy;
      if (flat_sq + rise * rise > radius * radius && flat_sq > 0.5f)
        continue;
      const std::size_t pixel = static_cast<std::size_t>(row) * target.width + static_cast<std::size_t>(column);
      const float depth = disc.depth + rise - kDome * (flat_sq + rise * rise) / radius;
      if (depth > target.depth[pixel]) {
        target.depth[pixel] = depth;
        target.point[pixel] = number;
      }
    }
}

} // namespace

VisibleSplats
drawSplats(const SplatCloud& cloud, const Camera& camera, std::size_t threads)
{
  const float radius = std::max(kLeastRadius, static_cast<float>(cloud.radius * camera.pixels_per_unit));
  std::vector<Disc> discs(cloud.points.size());
  parallelBlocks(discs.size(), kPointsPerBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      discs[i] = projectDisc(cloud, camera, i);
  });
  const Strips strips = sortIntoStrips(discs, radius, camera.width, camera.height);

  VisibleSplats visible;
  visible.width = camera.width;
  visible.height = camera.height;
  visible.point.assign(camera.width * camera.height, VisibleSplats::kNothing);
  visible.depth.assign(camera.width * camera.height, -std::numeric_limits<float>::infinity());
  parallelBlocks(strips.begin.size() - 1, 1, threads, [&](std::size_t strip, std::size_t) {
    const std::size_t first_row = strip * kRowsPerStrip;
    const std::size_t end_row = std::min(first_row + kRowsPerStrip, camera.height);
    for (std::size_t k = strips.begin[strip]; k < strips.begin[strip + 1]; ++k)
      drawDisc(discs[strips.points[k]], radius, strips.points[k], first_row, end_row, visible);
  });
  return visible;
}

} // namespace pcl_gpf
