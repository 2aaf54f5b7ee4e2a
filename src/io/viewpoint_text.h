// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

constexpr std::array<double, 7> kIdentityViewpoint{0, 0, 0, 1, 0, 0, 0};

/** \brief Seven numbers with one blank between them, in shortest digits. */
std::string viewpointText(const std::array<double, 7>& viewpoint);

/** \brief Parses exactly seven numbers. \return false, and \a viewpoint unchanged, on anything else */
bool parseViewpoint(const std::vector<std::string_view>& tokens, std::array<double, 7>& viewpoint);

/** \brief Keeps a comment of a PLY or XYZ file; "viewpoint" and seven numbers, as the writers note it, sets the
 * viewpoint. */
void takeComment(std::string_view text, CloudFile& cloud);

/** \brief The cloud's comments as lines fit for a header: split at line ends, control characters and over-long rests
 * dropped. */
std::vector<std::string> commentLines(const CloudFile& cloud);

} // namespace pcl_gpf
