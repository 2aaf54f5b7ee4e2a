// SPDX-License-Identifier: BSD-3-Clause
#include "color_map.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

Color
mapColor(double value)
{
  // Nine of the 256 colours of matplotlib's map (CC0); between them it is nearly linear.
  constexpr float kStops[9][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139}, {44, 113, 142}, {33, 144, 141},
                                  {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};
  if (std::isnan(value))
    return {0.6f, 0.6f, 0.6f};
  const double position = 8 * std::clamp(value, 0.0, 1.0);
  const auto below = std::min(static_cast<std::size_t>(position), std::size_t{7});
  const auto share = static_cast<float>(position - static_cast<double>(below));
  Color color;
  for (std::size_t channel = 0; channel < 3; ++channel)
    color[channel] = ((1 - share) * kStops[below][channel] + share * kStops[below + 1][channel]) / 255;
  return color;
}

} // namespace pcl_gpf
