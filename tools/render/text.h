// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "image.h"

#include <string>

namespace pcl_gpf {

/** \brief Height of a line of text, pixels. */
constexpr std::size_t kTextHeight = 14;

/** \brief Width of a text, pixels. */
std::size_t
textWidth(const std::string& text);

/** \brief Draws ASCII text with its upper left corner at (column, row); what does not fit is cut off, unknown characters become
 * question marks. */
void
drawText(const std::string& text, std::size_t column, std::size_t row, Color color, Image& image);

} // namespace pcl_gpf
