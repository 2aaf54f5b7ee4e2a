// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/analysis/surface_extent.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/rimls_mesh.h>

#include "../check_range.h"
#include "../sorted_points.h"
#include "rimls_work.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pcl_gpf {

namespace {

constexpr std::size_t kFewestPoints = 4;
/** r_i of an even cloud in spacings. */
constexpr double kRadiusInSpacings = 1.128;
/** Least scale where the cells, not the points, set the local radius. */
constexpr double kLeastScale = 3.5;
/** Shares of the work, for the progress. */
constexpr double kSeedsDone = 0.15, kCellsDone = 0.8;

/** Longest side of the box; of the middle 99 % of the points on each axis where the box is more than twice as long, as
 * with outliers. */
double
boxSide(PointsView points)
{
  double side = 0.0;
  for (const float* axis : {points.x, points.y, points.z}) {
    std::vector<float> values(axis, axis + points.size);
    const auto quantile = [&](double share) {
      const auto at =
          values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
      std::nth_element(values.begin(), at, values.end());
      return static_cast<double>(*at);
    };
    const double whole = quantile(1.0) - quantile(0.0), middle = quantile(0.995) - quantile(0.005);
    side = std::max(side, middle > 0.0 && whole > 2.0 * middle ? 1.1 * middle : whole);
  }
  return side;
}

std::string
gibibytes(double bytes)
{
  return toText(std::ceil(bytes / 1024 / 1024 / 1024 * 100.0) / 100.0) + " GiB";
}

void
refuseTooMuchMemory(double bytes, double limit, double cells_along_side)
{
  if (bytes > limit)
    throw ExcessiveWork("a resolution of " + toText(std::round(cells_along_side)) +
                        " cells along the longest side takes about " + gibibytes(bytes) + "; allowed are " +
                        gibibytes(limit) + ", enough for a resolution of about " +
                        toText(std::floor(cells_along_side * std::sqrt(limit / bytes))));
}

/** Local radii for cells that the points do not fill: a cell on a convex corner, which reaches a diagonal beyond the
 * surface, must be in the domain. The support stays what it is where it is wide enough for that. */
RimlsParameters
fitToCells(const RimlsMeshParameters& parameters, double cell_size, double spacing)
{
  RimlsParameters rimls = parameters.rimls;
  rimls.number_of_threads = parameters.number_of_threads;
  const double least = (0.9 * cell_size + spacing) * 2.0 / rimls.domain;
  const double natural = rimls.radius > 0.0 ? rimls.radius / rimls.scale : kRadiusInSpacings * spacing;
  rimls.minimum_radius = std::max(rimls.minimum_radius, least);
  if (least > natural) {
    const double scale = std::max(std::min(kLeastScale, rimls.scale), rimls.scale * natural / least);
    rimls.radius *= scale / rimls.scale;
    rimls.scale = scale;
  }
  return rimls;
}

/** One point of every cell, in the order of the index. */
SoaBuffer
thinned(PointsView points, double cell_size)
{
  using Cell = std::array<std::int64_t, 3>;
  std::vector<std::pair<Cell, std::size_t>> cells(points.size);
  for (std::size_t i = 0; i < points.size; ++i) {
    const float p[3] = {points.x[i], points.y[i], points.z[i]};
    for (std::size_t axis = 0; axis < 3; ++axis)
      cells[i].first[axis] = static_cast<std::int64_t>(std::floor(std::clamp(p[axis] / cell_size, -1e15, 1e15)));
    cells[i].second = i;
  }
  std::sort(cells.begin(), cells.end());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (i == 0 || cells[i].first != cells[i - 1].first)
      kept.push_back(cells[i].second);
  return elementsOf(points, kept);
}

/** Points moved onto the surface; those outside its domain or the lattice are left out. */
SoaBuffer
seedsOnSurface(const RimlsSurface& surface, double cell_size, const ProgressCallback& progress)
{
  constexpr double kFarthestCell = 500000.0;
  SoaBuffer seeds = thinned(surface.points().sorted(), cell_size), normals(seeds.size());
  std::vector<RimlsState> states(seeds.size());
  surface.project(seeds.view(), normals.view(), states.data(), {}, progress);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    const float farthest = std::max({std::abs(seeds.x[i]), std::abs(seeds.y[i]), std::abs(seeds.z[i])});
    if (states[i] != RimlsState::Outside && farthest < kFarthestCell * cell_size)
      kept.push_back(i);
  }
  return elementsOf(std::as_const(seeds).view(), kept);
}

/** \return mean movement */
double
projectVertices(const RimlsSurface& surface, double cell_size, SurfaceMesh& mesh, const ProgressCallback& progress)
{
  const std::size_t count = mesh.vertexCount();
  SoaBuffer moved(count);
  std::copy_n(mesh.vertices.x.data(), count, moved.x.data());
  std::copy_n(mesh.vertices.y.data(), count, moved.y.data());
  std::copy_n(mesh.vertices.z.data(), count, moved.z.data());
  mesh.normals = SoaBuffer(count);
  surface.project(moved.view(), mesh.normals.view(), nullptr, {}, progress);
  double movement = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = moved.x[i] - mesh.vertices.x[i], dy = moved.y[i] - mesh.vertices.y[i],
                 dz = moved.z[i] - mesh.vertices.z[i];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    if (length > cell_size) // ran away along an edge of the domain: the vertex between the corners is the better one
      continue;
    movement += length;
    mesh.vertices.x[i] = moved.x[i];
    mesh.vertices.y[i] = moved.y[i];
    mesh.vertices.z[i] = moved.z[i];
  }
  return movement / static_cast<double>(std::max<std::size_t>(1, count));
}

/** Spacing, cell, memory and work. */
void
foresee(const RimlsMeshParameters& parameters, PointsView points, const PointIndex& index, RimlsMeshStatistics& done)
{
  done.spacing = estimateSpacing(index, parameters.number_of_threads);
  if (points.size < kFewestPoints || !(done.spacing > 0.0))
    throw UnsuitableData(std::to_string(points.size) + " points" +
                         (points.size < kFewestPoints ? "" : " in one place") + " make no surface");
  if (!spansSurface(points))
    throw UnsuitableData("the " + std::to_string(points.size) + " points lie on one line and make no surface");
  const double side = boxSide(points);
  done.cell_size = parameters.cell_size > 0.0 ? parameters.cell_size : side / parameters.resolution;
  done.expected_memory =
      estimateSurfaceMemory(done.spacing * done.spacing * static_cast<double>(points.size), done.cell_size);
  refuseTooMuchMemory(done.expected_memory, static_cast<double>(parameters.memory_limit), side / done.cell_size);
  const double spacings = done.spacing / done.cell_size;
  refuseExcessiveMeshWork(fitToCells(parameters, done.cell_size, done.spacing), index, done.spacing,
                          spacings * spacings * static_cast<double>(points.size));
}

} // namespace

void
validate(const RimlsMeshParameters& p)
{
  validate(p.rimls);
  checkRange("resolution", p.resolution, p.resolution >= 2 && p.resolution <= 65536, "2 .. 65536");
  checkRange("cell_size", p.cell_size, p.cell_size >= 0.0, ">= 0, 0 = from the resolution");
  checkRange("smallest_component", p.smallest_component, p.smallest_component >= 0.0 && p.smallest_component <= 1.0,
             "0 .. 1");
  checkRange("largest_hole", p.largest_hole, p.largest_hole <= 1000, "0 .. 1000");
  checkRange("memory_limit", static_cast<double>(p.memory_limit), p.memory_limit >= 1, ">= 1 byte");
}

double
checkMeshMemory(const RimlsMeshParameters& parameters, PointsView points)
{
  validate(parameters);
  const PointIndex index(points, parameters.number_of_threads);
  RimlsMeshStatistics foreseen;
  foresee(parameters, points, index, foreseen);
  return foreseen.expected_memory;
}

SurfaceMesh
meshRimls(const RimlsMeshParameters& parameters, PointsView points, NormalsView normals,
          const ProgressCallback& progress, RimlsMeshStatistics* statistics)
{
  const auto start = std::chrono::steady_clock::now();
  validate(parameters);
  const PointIndex index(points, parameters.number_of_threads);
  RimlsMeshStatistics own;
  RimlsMeshStatistics& done = statistics ? *statistics : own;
  done = RimlsMeshStatistics();
  foresee(parameters, points, index, done);

  const RimlsParameters rimls = fitToCells(parameters, done.cell_size, done.spacing);
  const SoaBuffer sorted_normals = [&] {
    SoaBuffer sorted(points.size);
    for (std::size_t k = 0; k < points.size; ++k) {
      sorted.x[k] = normals.x[index.order()[k]];
      sorted.y[k] = normals.y[index.order()[k]];
      sorted.z[k] = normals.z[index.order()[k]];
    }
    return sorted;
  }();
  const RimlsSurface surface(rimls, index, sorted_normals.view());
  std::vector<float> radii = surface.supportRadii();
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  done.support_radius = radii[radii.size() / 2];

  MarchingCubesParameters cells;
  cells.cell_size = done.cell_size;
  cells.memory_limit = parameters.memory_limit;
  cells.number_of_threads = parameters.number_of_threads;
  cells.normals = !parameters.project_vertices;
  const ImplicitFunction function = [&](PointsView at, const ImplicitValues& values) { surface.evaluate(at, values); };
  const SoaBuffer seeds = seedsOnSurface(surface, done.cell_size, partOf(progress, 0.0, kSeedsDone));
  SurfaceMesh mesh =
      extractSurface(cells, function, seeds.view(), partOf(progress, kSeedsDone, kCellsDone), &done.cells);
  done.removed_components = removeSmallComponents(mesh, parameters.smallest_component);
  if (parameters.project_vertices) {
    done.mean_vertex_movement = projectVertices(surface, done.cell_size, mesh, partOf(progress, kCellsDone, 1.0));
    completeNormals(mesh);
  }
  done.filled_holes = fillSmallHoles(mesh, parameters.largest_hole);
  if (progress && !progress(1.0))
    throw Cancelled();
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return mesh;
}

} // namespace pcl_gpf
