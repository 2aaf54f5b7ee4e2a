// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Curves over logarithmic axes. */
struct Panel {
  struct Line {
    std::string label;
    std::size_t style = 0; ///< number of its colour, dash and marker; one label has one style in all panels
    std::vector<std::pair<double, double>> points; ///< x ascending; all above 0
  };
  std::string title, x_label, y_label;
  std::vector<Line> lines;
};

/** \brief Panels side by side above one legend, as a complete SVG document. The ticks along x are the x of the points.
 */
std::string
drawSvg(const std::string& title, const std::vector<Panel>& panels);

} // namespace pcl_gpf::quality
