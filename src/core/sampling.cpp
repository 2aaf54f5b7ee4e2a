// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/core/sampling.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_gpf {

std::uint64_t
SplitMix64::below(std::uint64_t bound)
{
  // Rejection keeps the distribution exact: values of the incomplete last interval are drawn again.
  const std::uint64_t limit = bound * (~std::uint64_t{0} / bound);
  std::uint64_t value = next();
  while (value >= limit)
    value = next();
  return value % bound;
}

double
SplitMix64::normal()
{
  constexpr double kTwoPi = 6.283185307179586;
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(kTwoPi * uniform());
}

std::vector<std::uint32_t>
randomSubset(std::size_t size, std::size_t count, std::uint64_t seed)
{
  std::vector<std::uint32_t> indices(size);
  std::iota(indices.begin(), indices.end(), std::uint32_t{0});
  if (count >= size)
    return indices;
  SplitMix64 random(seed);
  for (std::size_t i = 0; i < count; ++i) // Fisher-Yates, stopped after the wanted part
    std::swap(indices[i], indices[i + static_cast<std::size_t>(random.below(size - i))]);
  indices.resize(count);
  std::sort(indices.begin(), indices.end());
  return indices;
}

} // namespace pcl_gpf
