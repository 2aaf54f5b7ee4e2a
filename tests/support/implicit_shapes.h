// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <pcl_gpf/core/implicit_function.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace pcl_gpf::test {

/** \brief A function of one position; NaN = not defined. */
using ScalarField = std::function<double(const Vector3&)>;

/** \brief The field as the mesher takes it, its gradient by differences over 1e-3. */
inline ImplicitFunction
implicitFunction(const ScalarField& field)
{
  return [field](PointsView at, const ImplicitValues& out) {
    for (std::size_t i = 0; i < at.size; ++i) {
      const Vector3 p = {at.x[i], at.y[i], at.z[i]};
      const double f = field(p);
      if (out.value)
        out.value[i] = static_cast<float>(f);
      if (out.inside)
        out.inside[i] = !std::isnan(f);
      float* gradient[3] = {out.gradient.x, out.gradient.y, out.gradient.z};
      for (std::size_t axis = 0; axis < 3 && gradient[axis]; ++axis) {
        Vector3 low = p, high = p;
        low[axis] -= 5e-4;
        high[axis] += 5e-4;
        const double slope = (field(high) - field(low)) * 1e3;
        gradient[axis][i] = std::isfinite(slope) ? static_cast<float>(slope) : 0.0f;
      }
    }
  };
}

/** \brief Signed distance of the sphere of radius 1/2. */
inline double
sphereField(const Vector3& p)
{
  return std::hypot(p[0], p[1], p[2]) - 0.5;
}

/** \brief Signed distance of the torus of radii 0.35 and 0.13 about the z axis. */
inline double
torusField(const Vector3& p)
{
  return std::hypot(std::hypot(p[0], p[1]) - 0.35, p[2]) - 0.13;
}

/** \brief Signed distance (inside: the Chebyshev one) of a box of half edges 0.4, 0.3, 0.2. */
inline double
blockField(const Vector3& p)
{
  const double x = std::abs(p[0]) - 0.4, y = std::abs(p[1]) - 0.3, z = std::abs(p[2]) - 0.2;
  return std::hypot(std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0)) + std::min(std::max({x, y, z}), 0.0);
}

/** \brief The box of blockField(), sampled evenly, with exact normals. */
inline Shape
block(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    constexpr Vector3 kHalf = {0.4, 0.3, 0.2};
    constexpr double kAreas[2] = {0.3 * 0.2, 0.4 * 0.2}; // of the faces across x and y; across z: 0.4 * 0.3
    const double choice = random.uniform() * (kAreas[0] + kAreas[1] + 0.4 * 0.3);
    const std::size_t axis = choice < kAreas[0] ? 0 : choice < kAreas[0] + kAreas[1] ? 1 : 2;
    const double side = random.below(2) == 0 ? -1.0 : 1.0;
    for (std::size_t a = 0; a < 3; ++a)
      point[a] = (2 * random.uniform() - 1) * kHalf[a];
    point[axis] = side * kHalf[axis];
    normal = {0, 0, 0};
    normal[axis] = side;
  });
}

} // namespace pcl_gpf::test
