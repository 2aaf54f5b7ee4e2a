// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace pcl_gpf::benchmark_models {

/** \brief A block with a step: an L-shaped profile with six edges, 0.6 deep, sampled evenly over its surface. */
inline test::Shape
block(std::size_t count, double noise, std::uint64_t seed)
{
  constexpr double kProfile[7][2] = {{0, 0}, {1, 0}, {1, 0.3}, {0.5, 0.3}, {0.5, 0.7}, {0, 0.7}, {0, 0}};
  constexpr double kDepth = 0.6, kPerimeter = 3.4, kProfileArea = 0.5;
  return test::sampleShape(count, noise, seed, [&](SplitMix64& random, test::Vector3& point, test::Vector3& normal) {
    if (random.uniform() * (kPerimeter * kDepth + 2 * kProfileArea) < 2 * kProfileArea) { // an L-shaped end
      const double side = static_cast<double>(random.below(2));
      const bool low = random.uniform() < 0.6; // 1 x 0.3 of the area 0.5
      point = {low ? random.uniform() : 0.5 * random.uniform(), side * kDepth,
               low ? 0.3 * random.uniform() : 0.3 + 0.4 * random.uniform()};
      normal = {0, 2 * side - 1, 0};
      return;
    }
    double along = random.uniform() * kPerimeter;
    for (int edge = 0; edge < 6; ++edge) {
      const double dx = kProfile[edge + 1][0] - kProfile[edge][0], dz = kProfile[edge + 1][1] - kProfile[edge][1];
      const double length = std::abs(dx) + std::abs(dz); // all edges are parallel to an axis
      if (along > length && edge < 5) {
        along -= length;
        continue;
      }
      point = {kProfile[edge][0] + dx * along / length, kDepth * random.uniform(), kProfile[edge][1] + dz * along / length};
      normal = {dz / length, 0, -dx / length};
      return;
    }
  });
}

/** \brief A noisy model; `percent` of its box diagonal is the standard deviation along each axis. */
inline test::Shape
makeModel(const std::string& name, std::size_t count, double percent, std::uint64_t seed = 1)
{
  const double share = percent / 100;
  if (name == "block")
    return block(count, share * std::sqrt(1.0 + 0.36 + 0.49), seed);
  if (name == "cube")
    return test::cube(count, share * std::sqrt(3.0), seed);
  if (name == "sphere")
    return test::sphere(count, share * std::sqrt(3.0), seed);
  throw std::invalid_argument("unknown model \"" + name + "\"; there are block, cube and sphere");
}

} // namespace pcl_gpf::benchmark_models
