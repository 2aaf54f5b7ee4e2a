// SPDX-License-Identifier: BSD-3-Clause
#include "surface_follower.h"

#include "cell_polygons.h"
#include "check_range.h"

#include <pcl_gpf/core/errors.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_gpf {

namespace {

/** Corners evaluated in one call of the function. */
constexpr std::size_t kBatch = std::size_t{1} << 20;
/** What the mesh and its making take for a crossed cell: two triangles twice, a vertex with normal and gradient, the
 * cell's key. */
constexpr std::size_t kMeshBytesPerCell = 120;
constexpr std::size_t kBytesPerWaitingCell = 8 * (1 + 4); // its key and those of its new corners
constexpr std::uint32_t kLast = (1u << LatticePoint::kBitsPerAxis) - 3;

bool
onLattice(double coordinate)
{
  return coordinate >= 2.0 && coordinate <= static_cast<double>(kLast);
}

std::string
gibibytes(double bytes)
{
  return toText(std::round(bytes / 1024 / 1024 / 1024 * 100.0) / 100.0) + " GiB";
}

} // namespace

SurfaceFollower::SurfaceFollower(const MarchingCubesParameters& parameters, const ImplicitFunction& function)
: parameters_(parameters), function_(function)
{}

std::array<float, 3>
SurfaceFollower::position(LatticePoint corner, unsigned axis, double share) const
{
  const std::uint32_t coordinates[3] = {corner.x, corner.y, corner.z};
  std::array<float, 3> result{};
  for (unsigned a = 0; a < 3; ++a) {
    const double steps =
        static_cast<double>(coordinates[a]) - static_cast<double>(LatticePoint::kOrigin) + (a == axis ? share : 0.0);
    result[a] = static_cast<float>(parameters_.origin[a] + steps * parameters_.cell_size);
  }
  return result;
}

std::vector<std::uint64_t>
SurfaceFollower::seedCells(PointsView seeds) const
{
  std::vector<std::uint64_t> cells;
  const float* axes[3] = {seeds.x, seeds.y, seeds.z};
  for (std::size_t i = 0; i < seeds.size; ++i) {
    std::uint32_t cell[3] = {};
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const double steps =
          std::floor((axes[a][i] - parameters_.origin[a]) / parameters_.cell_size) + LatticePoint::kOrigin;
      inside = inside && onLattice(steps);
      cell[a] = inside ? static_cast<std::uint32_t>(steps) : 0;
    }
    if (!inside)
      throw InvalidParameter("a seed lies more than " + std::to_string(LatticePoint::kOrigin - 3) +
                             " cells from the origin of the lattice; choose a larger cell");
    cells.push_back(latticeKey({cell[0], cell[1], cell[2]}));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

bool
SurfaceFollower::visit(LatticePoint cell)
{
  const std::uint64_t key = latticeKey(cell);
  SparseLattice::Brick& brick = lattice_.brick(lattice_.makeBrick(key));
  if (brick.visited & SparseLattice::bitOf(key))
    return false;
  brick.visited |= SparseLattice::bitOf(key);
  return true;
}

void
SurfaceFollower::evaluateCorners(const std::vector<std::uint64_t>& cells)
{
  std::vector<std::uint64_t> wanted;
  CornerFinder finder(lattice_);
  for (const std::uint64_t cell : cells)
    for (const CornerFinder::Corner& corner : finder.corners(latticePoint(cell))) {
      SparseLattice::Brick& brick =
          lattice_.brick(corner.brick != SparseLattice::kAbsent ? corner.brick : lattice_.makeBrick(corner.key));
      if (brick.known & SparseLattice::bitOf(corner.key))
        continue;
      brick.known |= SparseLattice::bitOf(corner.key);
      wanted.push_back(corner.key);
    }
  std::sort(wanted.begin(), wanted.end());
  statistics_.corners += wanted.size();
  evaluate(wanted);
}

void
SurfaceFollower::evaluate(std::vector<std::uint64_t>& corners)
{
  SoaBuffer at(std::min(kBatch, corners.size()));
  std::vector<float> values(at.size());
  for (std::size_t begin = 0; begin < corners.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, corners.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<float, 3> p = position(latticePoint(corners[begin + i]));
      at.x[i] = p[0];
      at.y[i] = p[1];
      at.z[i] = p[2];
    }
    ImplicitValues out;
    out.value = values.data();
    function_({at.x.data(), at.y.data(), at.z.data(), count}, out);
    for (std::size_t i = 0; i < count; ++i)
      lattice_.brick(lattice_.findBrick(corners[begin + i])).values[corners[begin + i] & 63u] = values[i];
  }
}

void
SurfaceFollower::markEdges(const std::array<CornerFinder::Corner, 8>& corners, unsigned signs)
{
  for (unsigned edge = 0; edge < CellPolygons::kEdges; ++edge) {
    const unsigned begin = edgeCorner(edge), end = begin | 1u << edgeAxis(edge);
    if ((signs >> begin & 1u) != (signs >> end & 1u))
      lattice_.brick(corners[begin].brick).crossed[edgeAxis(edge)] |= SparseLattice::bitOf(corners[begin].key);
  }
}

void
SurfaceFollower::crossCells(const std::vector<std::uint64_t>& cells, std::vector<std::uint64_t>& next)
{
  constexpr unsigned kLowFace[3] = {0x55, 0x33, 0x0f}; // corners with 0 on the axis
  CornerFinder finder(lattice_);
  for (const std::uint64_t key : cells) {
    const LatticePoint cell = latticePoint(key);
    const std::array<CornerFinder::Corner, 8> corners = finder.corners(cell);
    float values[8];
    bool defined = true;
    for (std::size_t c = 0; c < 8; ++c) {
      values[c] = lattice_.brick(corners[c].brick).values[corners[c].key & 63u];
      defined = defined && std::isfinite(values[c]);
    }
    if (!defined) {
      ++statistics_.skipped_cells;
      continue;
    }
    const unsigned signs = signMask(values);
    if (signs == 0 || signs == 0xff)
      continue;
    cells_.push_back(key);
    markEdges(corners, signs);
    const std::uint32_t coordinates[3] = {cell.x, cell.y, cell.z};
    for (unsigned axis = 0; axis < 3; ++axis)
      for (unsigned side = 0; side < 2; ++side) {
        const unsigned face = side == 0 ? kLowFace[axis] : 0xff & ~kLowFace[axis];
        std::uint32_t neighbor[3] = {cell.x, cell.y, cell.z};
        neighbor[axis] = side == 0 ? coordinates[axis] - 1 : coordinates[axis] + 1;
        const bool crossed = (signs & face) != 0 && (signs & face) != face;
        if (crossed && onLattice(neighbor[axis]) && visit({neighbor[0], neighbor[1], neighbor[2]}))
          next.push_back(latticeKey({neighbor[0], neighbor[1], neighbor[2]}));
      }
  }
}

void
SurfaceFollower::checkMemory(std::size_t waiting) const
{
  const double bytes =
      static_cast<double>(lattice_.memory()) +
      static_cast<double>((cells_.size() + waiting) * kMeshBytesPerCell + waiting * kBytesPerWaitingCell);
  if (bytes > static_cast<double>(parameters_.memory_limit))
    throw ExcessiveWork(
        "the surface takes more than the allowed " + gibibytes(static_cast<double>(parameters_.memory_limit)) + " (" +
        std::to_string(cells_.size()) + " cells so far); choose a lower resolution or allow more memory");
}

void
SurfaceFollower::follow(PointsView seeds, const ProgressCallback& progress)
{
  std::vector<std::uint64_t> wave = seedCells(seeds), next;
  for (const std::uint64_t cell : wave)
    visit(latticePoint(cell));
  double fraction = 0.0;
  while (!wave.empty()) {
    checkMemory(wave.size());
    const double total = static_cast<double>(cells_.size() + 2 * wave.size());
    fraction = std::max(fraction, static_cast<double>(cells_.size()) / total);
    if (progress && !progress(0.9 * fraction))
      throw Cancelled();
    evaluateCorners(wave);
    next.clear();
    crossCells(wave, next);
    std::sort(next.begin(), next.end());
    wave.swap(next);
  }
  std::sort(cells_.begin(), cells_.end());
  statistics_.cells = cells_.size();
}

} // namespace pcl_gpf
