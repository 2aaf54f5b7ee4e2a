// SPDX-License-Identifier: BSD-3-Clause
#include "bar_chart.h"
#include "svg_text.h"

#include <algorithm>

namespace pcl_gpf::quality {

namespace {

constexpr double kBarWidth = 40, kBarGap = 26, kHeight = 170, kTop = 74, kMargin = 24, kBelow = 34;

double
widthOf(const BarPanel& panel)
{
  return static_cast<double>(panel.bars.size()) * (kBarWidth + kBarGap) + kBarGap;
}

const char*
colourOf(const std::string& label)
{
  return label.rfind("ours", 0) == 0 ? "#0072B2" : label == "input" || label == "clean" ? "#aaaaaa" : "#E69F00";
}

std::string
drawPanel(const BarPanel& panel, double left)
{
  double largest = 0;
  for (const BarPanel::Bar& bar : panel.bars)
    largest = std::max(largest, bar.value);
  const double base = kTop + kHeight;
  std::string svg = svgText(left + 0.5 * widthOf(panel), kTop - 24, panel.title, "middle", "font-weight=\"bold\"");
  double x = left + kBarGap;
  for (const BarPanel::Bar& bar : panel.bars) {
    const double height = largest > 0 ? kHeight * bar.value / largest : 0;
    svg += svgPrint("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x, base - height,
                    kBarWidth, height, colourOf(bar.label));
    const double middle = x + 0.5 * kBarWidth;
    svg += svgText(middle, base - height - 5, svgPrint("%.3g", bar.value)) + svgText(middle, base + 17, bar.label);
    x += kBarWidth + kBarGap;
  }
  return svg + svgPrint("<path d=\"M%.1f %.1fh%.1f\" stroke=\"#444\"/>\n", left, base, widthOf(panel));
}

} // namespace

std::string
drawBars(const std::string& title, const std::vector<BarPanel>& panels)
{
  double width = kMargin;
  for (const BarPanel& panel : panels)
    width += widthOf(panel) + kMargin;
  std::string svg = svgHead(width, kTop + kHeight + kBelow, title);
  double left = kMargin;
  for (const BarPanel& panel : panels) {
    svg += drawPanel(panel, left);
    left += widthOf(panel) + kMargin;
  }
  return svg + "</svg>\n";
}

} // namespace pcl_gpf::quality
