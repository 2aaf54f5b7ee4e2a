// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_lattice.h"

#include "spread_bits.h"

#include <algorithm>
#include <limits>

namespace pcl_gpf {

namespace {

std::uint32_t
gatherBits(std::uint64_t v)
{
  v &= 0x1249249249249249ull;
  v = (v | v >> 2) & 0x10c30c30c30c30c3ull;
  v = (v | v >> 4) & 0x100f00f00f00f00full;
  v = (v | v >> 8) & 0x1f0000ff0000ffull;
  v = (v | v >> 16) & 0x1f00000000ffffull;
  return static_cast<std::uint32_t>((v | v >> 32) & 0x1fffffull);
}

} // namespace

std::uint64_t
latticeKey(LatticePoint p)
{
  return spreadBits(p.x) | spreadBits(p.y) << 1 | spreadBits(p.z) << 2;
}

LatticePoint
latticePoint(std::uint64_t key)
{
  return {gatherBits(key), gatherBits(key >> 1), gatherBits(key >> 2)};
}

std::size_t
SparseLattice::slotOf(std::uint64_t brick_key) const
{
  const std::size_t mask = table_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(brick_key * 0x9e3779b97f4a7c15ull >> 20) & mask;
  while (table_[slot] != kAbsent && bricks_[table_[slot]].key != brick_key)
    slot = (slot + 1) & mask;
  return slot;
}

void
SparseLattice::grow()
{
  table_.assign(std::max<std::size_t>(64, 2 * table_.size()), kAbsent);
  for (std::size_t place = 0; place < bricks_.size(); ++place)
    table_[slotOf(bricks_[place].key)] = static_cast<std::uint32_t>(place);
}

std::uint32_t
SparseLattice::makeBrick(std::uint64_t corner_key)
{
  if (2 * (bricks_.size() + 1) > table_.size())
    grow();
  const std::size_t slot = slotOf(corner_key >> 6);
  if (table_[slot] == kAbsent) {
    table_[slot] = static_cast<std::uint32_t>(bricks_.size());
    Brick brick;
    brick.key = corner_key >> 6;
    brick.values.fill(std::numeric_limits<float>::quiet_NaN());
    bricks_.push_back(brick);
  }
  return table_[slot];
}

std::uint32_t
SparseLattice::findBrick(std::uint64_t corner_key) const
{
  return table_.empty() ? kAbsent : table_[slotOf(corner_key >> 6)];
}

std::uint32_t
CornerFinder::brickAt(LatticePoint cell, unsigned shift)
{
  if (!found_[shift]) {
    const LatticePoint in_brick = {(cell.x & ~3u) + 4 * (shift & 1u), (cell.y & ~3u) + 4 * (shift >> 1 & 1u),
                                   (cell.z & ~3u) + 4 * (shift >> 2 & 1u)};
    bricks_[shift] = lattice_.findBrick(latticeKey(in_brick));
    found_[shift] = bricks_[shift] != SparseLattice::kAbsent; // one that is made later is looked up again
  }
  return bricks_[shift];
}

std::array<CornerFinder::Corner, 8>
CornerFinder::corners(LatticePoint cell)
{
  const std::uint64_t home = latticeKey(cell) >> 6;
  if (home != home_) {
    home_ = home;
    found_.fill(false);
  }
  std::array<Corner, 8> result;
  for (unsigned c = 0; c < 8; ++c) {
    const LatticePoint corner = {cell.x + (c & 1u), cell.y + (c >> 1 & 1u), cell.z + (c >> 2 & 1u)};
    const unsigned shift = static_cast<unsigned>((corner.x ^ cell.x) >> 2 != 0) |
                           static_cast<unsigned>((corner.y ^ cell.y) >> 2 != 0) << 1 |
                           static_cast<unsigned>((corner.z ^ cell.z) >> 2 != 0) << 2;
    result[c] = {brickAt(cell, shift), latticeKey(corner)};
  }
  return result;
}

} // namespace pcl_gpf
