// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief A corner of the lattice, or the cell that begins there; kOrigin on each axis is the parameters' origin. */
struct LatticePoint {
  static constexpr unsigned kBitsPerAxis = 20;
  static constexpr std::uint32_t kOrigin = 1u << (kBitsPerAxis - 1);

  std::uint32_t x, y, z;
};

/** \brief Interleaved bits of the coordinates: ascending keys walk through space brick by brick. */
std::uint64_t
latticeKey(LatticePoint p);
LatticePoint
latticePoint(std::uint64_t key);

/** \brief Corners of a lattice in bricks of 4 x 4 x 4, which exist only where they are asked for. */
class SparseLattice {
public:
  static constexpr std::uint32_t kAbsent = 0xffffffffu;

  struct Brick {
    std::uint64_t key;                  ///< of its corners without the last 6 bits
    std::uint64_t known = 0;            ///< corners whose value was asked for
    std::uint64_t visited = 0;          ///< cells that were looked at
    std::array<std::uint64_t, 3> crossed{}; ///< edges along x, y, z with a vertex of the surface
    std::uint32_t first_vertex = 0;     ///< number of its first vertex
    std::array<float, 64> values;       ///< NaN where the function is not defined
  };

  /** \brief Place of the brick of a corner, made if it is not there. */
  std::uint32_t
  makeBrick(std::uint64_t corner_key);
  /** \brief Place of the brick, or kAbsent. */
  std::uint32_t
  findBrick(std::uint64_t corner_key) const;

  Brick& brick(std::uint32_t place) { return bricks_[place]; }
  const Brick& brick(std::uint32_t place) const { return bricks_[place]; }
  std::size_t brickCount() const { return bricks_.size(); }
  std::size_t memory() const { return bricks_.capacity() * sizeof(Brick) + table_.capacity() * sizeof(std::uint32_t); }

  static constexpr std::uint64_t bitOf(std::uint64_t corner_key) { return std::uint64_t{1} << (corner_key & 63u); }

private:
  void
  grow();
  std::size_t
  slotOf(std::uint64_t brick_key) const;

  std::vector<Brick> bricks_;
  std::vector<std::uint32_t> table_; ///< open addressing, a power of two
};

/** \brief Finds corners of cells; remembers the bricks about the last cell. One object a thread. */
class CornerFinder {
public:
  explicit CornerFinder(const SparseLattice& lattice) : lattice_(lattice) {}

  struct Corner {
    std::uint32_t brick; ///< kAbsent when there is none
    std::uint64_t key;
  };
  /** \brief The 8 corners of the cell, in the order of CellPolygons. */
  std::array<Corner, 8>
  corners(LatticePoint cell);

private:
  std::uint32_t
  brickAt(LatticePoint cell, unsigned shift);

  const SparseLattice& lattice_;
  std::uint64_t home_ = ~std::uint64_t{0};
  std::array<std::uint32_t, 8> bricks_{};
  std::array<bool, 8> found_{};
};

} // namespace pcl_gpf
