// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/marching_cubes.h>
#include <pcl_gpf/core/parallel.h>

#include "check_range.h"
#include "polygonizer.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

constexpr std::size_t kGradientsPerBatch = std::size_t{1} << 20;

SoaBuffer
gradients(const SoaBuffer& vertices, const ImplicitFunction& function)
{
  SoaBuffer result(vertices.size());
  for (std::size_t begin = 0; begin < vertices.size(); begin += kGradientsPerBatch) {
    ImplicitValues out;
    const std::size_t size = std::min(kGradientsPerBatch, vertices.size() - begin);
    out.gradient = {result.x.data() + begin, result.y.data() + begin, result.z.data() + begin, size};
    function({vertices.x.data() + begin, vertices.y.data() + begin, vertices.z.data() + begin, size}, out);
  }
  return result;
}

} // namespace

SurfaceMesh
extractSurface(const MarchingCubesParameters& parameters, const ImplicitFunction& function, PointsView seeds,
               const ProgressCallback& progress, MarchingCubesStatistics* statistics)
{
  checkRange("cell_size", parameters.cell_size, parameters.cell_size > 0.0, "> 0");
  SurfaceFollower follower(parameters, function);
  follower.follow(seeds, progress);
  SurfaceMesh mesh = Polygonizer(follower, resolveThreads(parameters.number_of_threads)).run();
  if (parameters.normals) {
    mesh.normals = gradients(mesh.vertices, function);
    completeNormals(mesh);
  }
  if (statistics)
    *statistics = follower.statistics();
  if (progress && !progress(1.0))
    throw Cancelled();
  return mesh;
}

double
estimateSurfaceMemory(double area, double cell_size)
{
  // A surface of random direction crosses 1.5 edges of the lattice for an area of one cell's face, and as many cells.
  return 250.0 * 1.5 * area / (cell_size * cell_size);
}

} // namespace pcl_gpf
