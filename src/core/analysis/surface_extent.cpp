// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cstdint>
#include <vector>

namespace pcl_gpf {

namespace {

/** Second eigenvalue of the covariance below this share of the first: all points lie on one line. */
constexpr double kLineRatio = 1e-12;

/** All of the points together. */
bool
spanTogether(PointsView points)
{
  if (points.size < 3)
    return false;
  double mean[3] = {}, c[3][3] = {};
  const float* axes[3] = {points.x, points.y, points.z};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t i = 0; i < points.size; ++i)
      mean[a] += static_cast<double>(axes[a][i]);
    mean[a] /= static_cast<double>(points.size);
  }
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a; b < 3; ++b)
      for (std::size_t i = 0; i < points.size; ++i)
        c[a][b] += (static_cast<double>(axes[a][i]) - mean[a]) * (static_cast<double>(axes[b][i]) - mean[b]);
  // Sum of the eigenvalues, and the sum of the products of two of them.
  const double sum = c[0][0] + c[1][1] + c[2][2];
  const double products = c[0][0] * c[1][1] - c[0][1] * c[0][1] + c[0][0] * c[2][2] - c[0][2] * c[0][2] +
                          c[1][1] * c[2][2] - c[1][2] * c[1][2];
  return sum > 0.0 && products > kLineRatio * sum * sum;
}

/** The points in the dense part of their box. */
SoaBuffer
densePart(PointsView points)
{
  const float* axes[3] = {points.x, points.y, points.z};
  const auto coordinate = [&axes](std::size_t i, std::size_t axis) { return static_cast<double>(axes[axis][i]); };
  BoundingBox box;
  for (std::size_t i = 0; i < points.size; ++i)
    box.add(coordinate(i, 0), coordinate(i, 1), coordinate(i, 2));
  const BoundingBox dense = denseBox(box, points.size, coordinate);
  std::vector<std::uint32_t> inside;
  for (std::size_t i = 0; i < points.size; ++i)
    if (dense.contains(coordinate(i, 0), coordinate(i, 1), coordinate(i, 2)))
      inside.push_back(static_cast<std::uint32_t>(i));
  return elementsOf(points, inside);
}

} // namespace

bool
spansSurface(PointsView points)
{
  if (spanTogether(points))
    return true;
  const SoaBuffer dense = densePart(points); // beside a point far away the others look like one
  return spanTogether(dense.view());
}

} // namespace pcl_gpf
