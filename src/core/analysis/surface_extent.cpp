// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/surface_extent.h>

namespace pcl_gpf {

namespace {

/** Second eigenvalue of the covariance below this share of the first: all points lie on one line. */
constexpr double kLineRatio = 1e-12;

} // namespace

bool
spansSurface(PointsView points)
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

} // namespace pcl_gpf
