// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "image.h"
#include "picture_cloud.h"

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief The colours in the file of the points shown: rgb, rgba, or red green blue.
 * \return empty when it has none */
std::vector<Color>
colorsInFile(const PictureCloud& cloud);

/** \brief Values of a field for the points shown. \return empty when the file has no such field */
std::vector<double>
fieldValues(const PictureCloud& cloud, const std::string& field);

/** \brief Values that a colour map spans. */
struct ValueRange {
  double low = 0;
  double high = 1;
};

/** \brief The range of the finite values without the outermost two hundredths of them on each side. */
ValueRange
typicalRange(std::vector<double> values);

/** \brief Colours of values by mapColor(). */
std::vector<Color>
mapColors(const std::vector<double>& values, const ValueRange& range);

} // namespace pcl_gpf
