// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/sampling.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf::test {

using Vector3 = std::array<double, 3>;

/** \brief Seeded samples of a surface with exact normals; a noisy point keeps the normal of the clean one that it came
 * from. */
struct Shape {
  std::vector<Vector3> points;
  std::vector<Vector3> normals; ///< unit length, outward

  std::size_t size() const { return points.size(); }
};

/** \brief Makes a sample of a surface from random numbers. */
template <typename Sampler> Shape
sampleShape(std::size_t count, double noise, std::uint64_t seed, Sampler sampler)
{
  Shape shape;
  SplitMix64 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    Vector3 point, normal;
    sampler(random, point, normal);
    for (double& coordinate : point)
      coordinate += noise * random.normal();
    shape.points.push_back(point);
    shape.normals.push_back(normal);
  }
  return shape;
}

/** \brief Unit square at z = 0. \param[in] noise standard deviation along each axis, as for all shapes */
inline Shape
plane(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    point = {random.uniform(), random.uniform(), 0};
    normal = {0, 0, 1};
  });
}

/** \brief Surface of the unit cube [0, 1]^3. */
inline Shape
cube(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    const std::size_t axis = random.below(3);
    const double side = static_cast<double>(random.below(2));
    point = {random.uniform(), random.uniform(), random.uniform()};
    point[axis] = side;
    normal = {0, 0, 0};
    normal[axis] = 2 * side - 1;
  });
}

/** \brief Sphere of radius 1/2 about the origin. */
inline Shape
sphere(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    normal = {random.normal(), random.normal(), random.normal()};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[axis] /= length;
      point[axis] = 0.5 * normal[axis];
    }
  });
}

/** \brief Torus about the z axis: the centre of its tube, of radius 0.35, runs at distance 1. */
inline Shape
torus(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    constexpr double kTube = 0.35, kTwoPi = 6.28318530717958647692;
    const double around = kTwoPi * random.uniform();
    double across = 0;
    do // by area: the outside of the tube has more of it
      across = kTwoPi * random.uniform();
    while (random.uniform() * (1 + kTube) > 1 + kTube * std::cos(across));
    normal = {std::cos(around) * std::cos(across), std::sin(around) * std::cos(across), std::sin(across)};
    point = {std::cos(around) + kTube * normal[0], std::sin(around) + kTube * normal[1], kTube * normal[2]};
  });
}

/** \brief Two unit squares at z = 0 and z = `gap`. */
inline Shape
sheets(std::size_t count, double gap, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [gap](SplitMix64& random, Vector3& point, Vector3& normal) {
    const bool upper = random.below(2) == 1;
    point = {random.uniform(), random.uniform(), upper ? gap : 0};
    normal = {0, 0, upper ? 1.0 : -1.0};
  });
}

/** \brief A wavy unit square in scan lines along x, five times as far apart as the steps along them. */
inline Shape
scanLines(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  const auto lines = static_cast<std::size_t>(std::sqrt(static_cast<double>(count) / 5));
  std::size_t i = 0;
  return sampleShape(count, noise, seed, [lines, count, i](SplitMix64&, Vector3& point, Vector3& normal) mutable {
    const double x = static_cast<double>(i / lines) * static_cast<double>(lines) / static_cast<double>(count);
    const double y = static_cast<double>(i % lines) / static_cast<double>(lines);
    point = {x, y, 0.2 * std::cos(3 * x) * std::cos(3 * y)};
    normal = {0.6 * std::sin(3 * x) * std::cos(3 * y), 0.6 * std::cos(3 * x) * std::sin(3 * y), 1};
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (double& coordinate : normal)
      coordinate /= length;
    ++i;
  });
}

/** \brief Two unit squares that meet at a right angle along the y axis. */
inline Shape
edge(std::size_t count, double noise = 0, std::uint64_t seed = 1)
{
  return sampleShape(count, noise, seed, [](SplitMix64& random, Vector3& point, Vector3& normal) {
    const bool upright = random.below(2) == 1;
    const double across = random.uniform();
    point = {upright ? 0 : across, random.uniform(), upright ? -across : 0};
    normal = {upright ? -1.0 : 0.0, 0, upright ? 0.0 : 1.0};
  });
}

} // namespace pcl_gpf::test
