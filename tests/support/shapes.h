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
sampleShape(std::size_t count, double noise, std::uint64_t seed, const Sampler& sampler)
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
