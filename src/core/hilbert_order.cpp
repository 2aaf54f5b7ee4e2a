// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/cluster_tree.h>
#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/parallel.h>

#include "sorted_points.h"
#include "spread_bits.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pcl_gpf {

namespace {

constexpr unsigned kBitsPerAxis = 21; // three axes fill a 63-bit key
constexpr std::size_t kPointsPerTask = 16384;

/** Points whose keys are computed together: compilers make loops over so many into vector instructions. */
constexpr std::size_t kKeysAtOnce = 64;
using Coordinates = std::array<std::uint32_t, kKeysAtOnce>;
struct Cells {
  Coordinates x{}, y{}, z{};
};

/** All ones where the bit is set. */
std::uint32_t
onesWhere(std::uint32_t value, unsigned place)
{
  return 0u - (value >> place & 1u);
}

/** Inverts the low bits of x where the bit of another axis is set, else exchanges them with that axis'. */
void
invertOrExchange(Coordinates& x, Coordinates& other, unsigned place)
{
  const std::uint32_t below = (1u << place) - 1;
  for (std::size_t k = 0; k < kKeysAtOnce; ++k) {
    const std::uint32_t set = onesWhere(other[k], place);
    const std::uint32_t exchanged = (x[k] ^ other[k]) & below & ~set;
    x[k] ^= (below & set) | exchanged;
    other[k] ^= exchanged;
  }
}

/** Cells to indices along the Hilbert curve, whose bits are still apart (Skilling, "Programming the Hilbert curve", 2004). */
void
followCurve(Cells& cells)
{
  for (unsigned place = kBitsPerAxis - 1; place > 0; --place) {
    for (std::uint32_t& x : cells.x)
      x ^= ((1u << place) - 1) & onesWhere(x, place);
    invertOrExchange(cells.x, cells.y, place);
    invertOrExchange(cells.x, cells.z, place);
  }
  for (std::size_t k = 0; k < kKeysAtOnce; ++k) {
    cells.y[k] ^= cells.x[k];
    cells.z[k] ^= cells.y[k];
  }
  Coordinates flip{};
  for (unsigned place = kBitsPerAxis - 1; place > 0; --place)
    for (std::size_t k = 0; k < kKeysAtOnce; ++k)
      flip[k] ^= ((1u << place) - 1) & onesWhere(cells.z[k], place);
  for (std::size_t k = 0; k < kKeysAtOnce; ++k) {
    cells.x[k] ^= flip[k];
    cells.y[k] ^= flip[k];
    cells.z[k] ^= flip[k];
  }
}

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;
using Histogram = std::array<std::uint32_t, kBuckets>;

std::size_t
digitOf(std::uint64_t key, unsigned shift)
{
  return (key >> shift) & (kBuckets - 1);
}

/** Turns the counts of each block into the place of its first element of each bucket. \return false when one bucket holds all */
bool
placesFromCounts(std::vector<Histogram>& blocks, std::size_t size)
{
  std::uint32_t sum = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    const std::uint32_t before = sum;
    for (Histogram& block : blocks)
      sum += std::exchange(block[bucket], sum);
    if (sum - before == size)
      return false;
  }
  return true;
}

/** Stable least-significant-digit radix sort of values by 63-bit keys; digits that all keys share are skipped. Every fixed block
 * counts and moves its own elements, so that blocks run in parallel and the result is that of one. */
void
radixSort(std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& values, std::size_t threads)
{
  constexpr std::size_t kBlock = 65536;
  std::vector<std::uint64_t> other_keys(keys.size());
  std::vector<std::uint32_t> other_values(values.size());
  std::vector<Histogram> places((keys.size() + kBlock - 1) / kBlock);
  for (unsigned shift = 0; shift < 63; shift += kDigitBits) {
    parallelBlocks(keys.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
      Histogram& counts = places[begin / kBlock];
      counts.fill(0);
      for (std::size_t i = begin; i < end; ++i)
        ++counts[digitOf(keys[i], shift)];
    });
    if (!placesFromCounts(places, keys.size()))
      continue;
    parallelBlocks(keys.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
      Histogram& next = places[begin / kBlock];
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t target = next[digitOf(keys[i], shift)]++;
        other_keys[target] = keys[i];
        other_values[target] = values[i];
      }
    });
    keys.swap(other_keys);
    values.swap(other_values);
  }
}

/** The box that the curve fills; points outside it share its border cells. */
BoundingBox
curveBox(PointsView points)
{
  BoundingBox box;
  for (std::size_t i = 0; i < points.size; ++i)
    box.add(points.x[i], points.y[i], points.z[i]);
  const float* axes[3] = {points.x, points.y, points.z};
  return denseBox(box, points.size, [&](std::size_t i, std::size_t axis) { return static_cast<double>(axes[axis][i]); });
}

} // namespace

std::vector<std::uint32_t>
hilbertOrder(PointsView points, std::size_t threads)
{
  checkPointCount(points.size);
  std::vector<std::uint32_t> order(points.size);
  if (points.size == 0)
    return order;
  const BoundingBox box = curveBox(points);
  const double extent = std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  constexpr double kLastCell = (1u << kBitsPerAxis) - 1;
  const double to_cell = extent > 0.0 ? kLastCell / extent : 0.0;

  std::vector<std::uint64_t> keys(points.size);
  parallelBlocks(points.size, kPointsPerTask, threads, [&](std::size_t begin, std::size_t end) {
    const auto cell = [&](float p, std::size_t axis) {
      return static_cast<std::uint32_t>(std::clamp((p - box.min[axis]) * to_cell, 0.0, kLastCell));
    };
    Cells cells;
    for (std::size_t first = begin; first < end; first += kKeysAtOnce) {
      const std::size_t count = std::min(end - first, kKeysAtOnce);
      for (std::size_t k = 0; k < count; ++k) {
        cells.x[k] = cell(points.x[first + k], 0);
        cells.y[k] = cell(points.y[first + k], 1);
        cells.z[k] = cell(points.z[first + k], 2);
      }
      followCurve(cells);
      for (std::size_t k = 0; k < count; ++k) {
        keys[first + k] = spreadBits(cells.x[k]) << 2 | spreadBits(cells.y[k]) << 1 | spreadBits(cells.z[k]);
        order[first + k] = static_cast<std::uint32_t>(first + k);
      }
    }
  });
  radixSort(keys, order, threads);
  return order;
}

} // namespace pcl_gpf
