// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "image.h"
#include "point_colors.h"

#include <string>
#include <vector>

namespace pcl_gpf {

constexpr Color kPaper{0.965f, 0.968f, 0.972f}; ///< background of a picture
constexpr Color kInk{0.15f, 0.17f, 0.20f};      ///< its text

/** \brief Pictures of one size side by side, each under its label; no strip for labels when all are empty. */
Image
composeSideBySide(const std::vector<Image>& panels, const std::vector<std::string>& labels);

/** \brief The image with a strip below that explains the colour map. */
Image
withLegend(const Image& image, const std::string& title, const ValueRange& range);

} // namespace pcl_gpf
