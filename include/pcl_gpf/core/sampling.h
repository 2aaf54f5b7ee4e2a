// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** \brief Counter-based random numbers (SplitMix64): the same sequence on every platform for one seed. */
class SplitMix64 {
public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t
  next()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /** \brief Uniform in [0, 1), 53 bits. */
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /** \brief Uniform integer in [0, bound), without bias; bound > 0. */
  PCL_GPF_CORE_EXPORT std::uint64_t
  below(std::uint64_t bound);
  /** \brief Standard normal (Box-Muller). */
  PCL_GPF_CORE_EXPORT double
  normal();

private:
  std::uint64_t state_;
};

/** \brief `count` different indices of [0, size), ascending, every subset equally likely; all of them when count >= size. */
PCL_GPF_CORE_EXPORT std::vector<std::uint32_t>
randomSubset(std::size_t size, std::size_t count, std::uint64_t seed);

} // namespace pcl_gpf
