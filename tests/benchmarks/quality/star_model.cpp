// SPDX-License-Identifier: BSD-3-Clause
#include "star_model.h"
#include "mesh_surface.h"

#include <cmath>

namespace pcl_gpf::quality {

std::shared_ptr<const Surface>
starSurface()
{
  constexpr std::uint32_t kCorners = 10; // five points and the five notches between them
  constexpr double kPi = 3.14159265358979323846, kPoint = 1, kNotch = 0.55, kWall = 0.22, kApex = 0.5;
  TriangleMesh mesh;
  const auto addVertex = [&](double x, double y, double z) { mesh.vertices.insert(mesh.vertices.end(), {x, y, z}); };
  for (const double side : {-1.0, 1.0})
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      const double radius = i % 2 == 0 ? kPoint : kNotch, angle = 2 * kPi * i / kCorners;
      addVertex(radius * std::cos(angle), radius * std::sin(angle), side * kWall);
    }
  addVertex(0, 0, -kApex);
  addVertex(0, 0, kApex);
  constexpr std::uint32_t kBottom = 2 * kCorners, kTop = kBottom + 1;
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const std::uint32_t next = (i + 1) % kCorners, above = i + kCorners, next_above = next + kCorners;
    mesh.triangles.insert(mesh.triangles.end(), {kBottom, next, i, kTop, above, next_above, // the slanted faces
                                                 i, next, next_above, i, next_above, above}); // the wall between them
  }
  return meshSurface(mesh);
}

} // namespace pcl_gpf::quality
