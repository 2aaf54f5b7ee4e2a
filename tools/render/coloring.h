// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "picture_cloud.h"
#include "point_colors.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What the colours of a picture shall be. */
struct ColoringRequest {
  std::string mode;           ///< "shade": all plain; "rgb": those of the files; else the name of a field
  Color plain{};              ///< of clouds that do not have what `mode` asks for
  std::optional<double> low;  ///< value of the field at the dark end; typicalRange() without it
  std::optional<double> high; ///< value of the field at the bright end
};

/** \brief The colours of all clouds of a picture. */
struct Coloring {
  std::vector<std::vector<Color>> colors; ///< per cloud and point
  std::optional<ValueRange> range;        ///< of the colour map, when a field gives the colours
};

/** \brief Colours the clouds, by one colour map for all. \throws UnsuitableData if none has colours or the field */
Coloring
colorClouds(const std::vector<PictureCloud>& clouds, const ColoringRequest& request);

} // namespace pcl_gpf
