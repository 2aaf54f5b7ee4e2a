// SPDX-License-Identifier: BSD-3-Clause
#include "camera.h"

#include <pcl_gpf/core/dense_box.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace pcl_gpf {

namespace {

/** The range of coordinates along an axis without the outermost thousandth on each side. */
std::pair<double, double>
extent(const std::vector<Position>& points, const Position& origin, const Position& axis)
{
  std::vector<double> values(points.size());
  std::transform(points.begin(), points.end(), values.begin(),
                 [&](const Position& point) { return dot(subtract(point, origin), axis); });
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 1000);
  const auto low = values.begin() + cut;
  const auto high = values.end() - 1 - cut;
  std::nth_element(values.begin(), low, values.end());
  const double lowest = *low;
  std::nth_element(values.begin(), high, values.end());
  return {lowest, *high};
}

/** The points in the dense part of their box. */
std::vector<Position>
densePart(const std::vector<Position>& points)
{
  BoundingBox box;
  for (const Position& p : points)
    box.add(p[0], p[1], p[2]);
  const BoundingBox dense = denseBox(box, points.size(), [&points](std::size_t i, std::size_t axis) { return points[i][axis]; });
  std::vector<Position> inside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(inside),
               [&dense](const Position& p) { return dense.contains(p[0], p[1], p[2]); });
  return inside.empty() ? points : inside;
}

} // namespace

View
makeView(const Position& toward, const Position& up)
{
  View view;
  view.toward = normalized(toward);
  view.right = cross(up, view.toward);
  if (length(view.right) < 1e-6 * length(up))
    view.right = cross(std::abs(view.toward[1]) < 0.9 ? Position{0, 1, 0} : Position{0, 0, -1}, view.toward);
  view.right = normalized(view.right);
  view.up = cross(view.toward, view.right);
  return view;
}

View
automaticView(const BoundingBox& box, const Position& sensor)
{
  const Position middle{0.5 * (box.min[0] + box.max[0]), 0.5 * (box.min[1] + box.max[1]), 0.5 * (box.min[2] + box.max[2])};
  const Position to_sensor = subtract(sensor, middle);
  double outside = 0; // how far the sensor is from the box
  for (std::size_t axis = 0; axis < 3; ++axis)
    outside = std::max({outside, box.min[axis] - sensor[axis], sensor[axis] - box.max[axis]});
  if (outside < 0.25 * box.diagonal() || outside > 20 * box.diagonal())
    return makeView({0.55, -1.0, 0.65}, {0, 0, 1});
  const double depth = std::abs(to_sensor[2]);
  const bool along_z = depth > std::abs(to_sensor[0]) && depth > std::abs(to_sensor[1]);
  const Position up = along_z ? Position{0, to_sensor[2] < 0 ? -1.0 : 1.0, 0} : Position{0, 0, 1};
  const View straight = makeView(to_sensor, up);
  return makeView(addScaled(addScaled(straight.toward, 0.22, straight.right), 0.16, straight.up), up);
}

Camera
fitCamera(const View& view, const std::vector<Position>& all, std::size_t width, std::size_t height)
{
  constexpr double kFilled = 0.92;
  const std::vector<Position> points = densePart(all);
  const Position origin = points.front(); // differences keep the detail of large coordinates
  const auto [left, right] = extent(points, origin, view.right);
  const auto [bottom, top] = extent(points, origin, view.up);
  const auto [back, front] = extent(points, origin, view.toward);
  Camera camera;
  camera.view = view;
  camera.width = width;
  camera.height = height;
  camera.centre = addScaled(origin, 0.5 * (left + right), view.right);
  camera.centre = addScaled(camera.centre, 0.5 * (bottom + top), view.up);
  camera.centre = addScaled(camera.centre, 0.5 * (back + front), view.toward);
  const double units_per_pixel = std::max((right - left) / (kFilled * static_cast<double>(width)),
                                          (top - bottom) / (kFilled * static_cast<double>(height)));
  camera.pixels_per_unit = units_per_pixel > 0 ? 1 / units_per_pixel : 1;
  return camera;
}

} // namespace pcl_gpf
