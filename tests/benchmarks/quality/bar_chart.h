// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Bars that start at 0, each with its value above it. */
struct BarPanel {
  struct Bar {
    std::string label;
    double value = 0; ///< finite, >= 0
  };
  std::string title; ///< with the unit
  std::vector<Bar> bars;
};

/** \brief Panels side by side, as a complete SVG document. A bar whose label begins with "ours" is drawn in
 * this project's colour, "input" and "clean" in grey. */
std::string
drawBars(const std::string& title, const std::vector<BarPanel>& panels);

} // namespace pcl_gpf::quality
