// SPDX-License-Identifier: BSD-3-Clause
#include "svg_plot.h"
#include "svg_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pcl_gpf::quality {

namespace {

constexpr double kPlotWidth = 300, kPlotHeight = 250, kLeft = 62, kTop = 64, kGap = 34, kBelow = 52, kLegendRow = 20,
                 kLegendColumn = 170;

/** Colours that people with any kind of colour vision tell apart (Okabe and Ito); dashes and markers tell them apart in
 * grey too. */
struct Style {
  const char* colour;
  const char* dash;
  char marker; ///< o circle, s square, t triangle, d diamond, - none
  double width;
};
constexpr Style kStyles[] = {{"#888888", "5 4", '-', 1.5}, {"#888888", "1 4", '-', 1.5}, {"#0072B2", "", 'o', 2.8},
                             {"#D55E00", "", 's', 1.5},    {"#009E73", "", 't', 1.5},    {"#CC79A7", "", 'd', 1.5},
                             {"#E69F00", "6 3", 's', 1.5}, {"#56B4E9", "6 3", 't', 1.5}, {"#000000", "6 3", 'd', 1.5}};

const Style&
styleOf(std::size_t number)
{
  const std::size_t count = std::size(kStyles);
  return kStyles[number < count ? number
                                : 3 + (number - 3) % (count - 3)]; // the first three are for input, floor and our own
}

std::string
marker(const Style& style, double x, double y)
{
  switch (style.marker) {
  case 'o':
    return svgPrint("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.6\" fill=\"%s\"/>\n", x, y, style.colour);
  case 's':
    return svgPrint("<rect x=\"%.1f\" y=\"%.1f\" width=\"6\" height=\"6\" fill=\"%s\"/>\n", x - 3, y - 3, style.colour);
  case 't':
    return svgPrint("<path d=\"M%.1f %.1fl4 7h-8z\" fill=\"%s\"/>\n", x, y - 4.5, style.colour);
  case 'd':
    return svgPrint("<path d=\"M%.1f %.1fl4 4l-4 4l-4 -4z\" fill=\"%s\"/>\n", x, y - 4, style.colour);
  default:
    return "";
  }
}

/** A logarithmic axis from a to b (pixels). */
struct Axis {
  double low = 1, high = 10, a = 0, b = 1;

  double
  at(double value) const
  {
    return a + (b - a) * std::log(value / low) / std::log(high / low);
  }
};

/** Covers the values with a margin. */
Axis
axisOver(const std::set<double>& values, double a, double b)
{
  constexpr double kMargin = 1.12;
  const double low = values.empty() ? 1 : *values.begin(), high = values.empty() ? 10 : *values.rbegin();
  return {low / kMargin, high * kMargin, a, b};
}

/** 1, 2 and 5 times powers of ten within the axis; also 3 and 7 where these are few. */
std::vector<double>
ticks(const Axis& axis)
{
  std::vector<double> found;
  for (const std::vector<double>& digits :
       {std::vector<double>{1, 2, 5}, std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}}) {
    found.clear();
    for (double decade = std::pow(10, std::floor(std::log10(axis.low))); decade <= axis.high; decade *= 10)
      for (const double digit : digits)
        if (digit * decade >= axis.low && digit * decade <= axis.high)
          found.push_back(digit * decade);
    constexpr std::size_t kEnough = 3;
    if (found.size() >= kEnough)
      break;
  }
  return found;
}

std::string
drawAxes(const Panel& panel, const Axis& x, const Axis& y, const std::set<double>& xs)
{
  std::string svg =
      svgPrint("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#444\"/>\n", x.a, y.b,
               x.b - x.a, y.a - y.b);
  for (const double v : ticks(y)) {
    svg += svgPrint("<path d=\"M%.1f %.1fh%.1f\" stroke=\"#ddd\"/>\n", x.a, y.at(v), x.b - x.a);
    svg += svgText(x.a - 6, y.at(v) + 4, svgPrint("%g", v), "end");
  }
  double last = -1e9;
  for (const double v : xs) {
    svg += svgPrint("<path d=\"M%.1f %.1fv%.1f\" stroke=\"#ddd\"/>\n", x.at(v), y.a, y.b - y.a);
    constexpr double kLabelWidth = 24;
    if (x.at(v) - last < kLabelWidth)
      continue;
    last = x.at(v);
    svg += svgText(x.at(v), y.a + 16, svgPrint("%g", v));
  }
  const double middle = 0.5 * (x.a + x.b), height = 0.5 * (y.a + y.b);
  svg += svgText(middle, y.a + 34, panel.x_label) +
         svgText(middle, y.b - 9, panel.title, "middle", "font-weight=\"bold\"");
  return svg + svgText(x.a - 44, height, panel.y_label, "middle",
                       svgPrint("transform=\"rotate(-90 %.1f %.1f)\"", x.a - 44, height).c_str());
}

std::string
drawLine(const Panel::Line& line, const Axis& x, const Axis& y)
{
  const Style& style = styleOf(line.style);
  std::string path, markers;
  for (const auto& [px, py] : line.points) {
    path += svgPrint("%s%.1f %.1f", path.empty() ? "M" : "L", x.at(px), y.at(py));
    markers += marker(style, x.at(px), y.at(py));
  }
  return "<path d=\"" + path +
         svgPrint("\" fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-dasharray=\"%s\"/>\n", style.colour,
                  style.width, style.dash) +
         markers;
}

std::string
drawPanel(const Panel& panel, double left)
{
  std::set<double> xs, ys;
  for (const Panel::Line& line : panel.lines)
    for (const auto& [x, y] : line.points) {
      xs.insert(x);
      ys.insert(y);
    }
  const Axis x = axisOver(xs, left, left + kPlotWidth), y = axisOver(ys, kTop + kPlotHeight, kTop);
  std::string svg = drawAxes(panel, x, y, xs);
  std::vector<const Panel::Line*> order;
  for (const Panel::Line& line : panel.lines)
    order.push_back(&line);
  const auto thinner = [](const Panel::Line* a, const Panel::Line* b) {
    return styleOf(a->style).width < styleOf(b->style).width;
  };
  std::stable_sort(order.begin(), order.end(), thinner); // the thickest on top
  for (const Panel::Line* line : order)
    svg += drawLine(*line, x, y);
  return svg;
}

std::string
drawLegend(const std::map<std::size_t, std::string>& labels, double top, std::size_t columns)
{
  std::string svg;
  std::size_t i = 0;
  for (const auto& [number, label] : labels) {
    const double x = kLeft + kLegendColumn * static_cast<double>(i % columns),
                 y = top + kLegendRow * static_cast<double>(i / columns);
    const Style& style = styleOf(number);
    svg += svgPrint("<path d=\"M%.1f %.1fh30\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-dasharray=\"%s\"/>\n", x, y,
                    style.colour, style.width, style.dash);
    svg += marker(style, x + 15, y) + svgText(x + 37, y + 4, label, "start");
    ++i;
  }
  return svg;
}

} // namespace

std::string
drawSvg(const std::string& title, const std::vector<Panel>& panels)
{
  std::map<std::size_t, std::string> labels;
  for (const Panel& panel : panels)
    for (const Panel::Line& line : panel.lines)
      labels.emplace(line.style, line.label);
  const auto count = static_cast<double>(panels.size());
  const double width = kLeft + count * kPlotWidth + (count - 1) * (kGap + kLeft) + 16;
  const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((width - kLeft) / kLegendColumn));
  const double legend_top = kTop + kPlotHeight + kBelow,
               rows = std::ceil(static_cast<double>(labels.size()) / static_cast<double>(columns));
  const double height = legend_top + kLegendRow * rows;
  std::string svg = svgHead(width, height, title);
  for (std::size_t i = 0; i < panels.size(); ++i)
    svg += drawPanel(panels[i], kLeft + static_cast<double>(i) * (kPlotWidth + kGap + kLeft));
  return svg + drawLegend(labels, legend_top, columns) + "</svg>\n";
}

} // namespace pcl_gpf::quality
