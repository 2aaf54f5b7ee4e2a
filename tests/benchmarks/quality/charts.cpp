// SPDX-License-Identifier: BSD-3-Clause
#include "charts.h"
#include "svg_plot.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>

namespace pcl_gpf::quality {

std::string
seriesOf(const Record& r)
{
  constexpr std::size_t kUsualSize = 33490;
  std::string name = r.model;
  if (r.noise.kind != NoiseKind::Gaussian)
    name += std::string("_") + nameOf(r.noise.kind);
  if (r.size != kUsualSize)
    name += "_" + std::to_string(r.size);
  if (r.noise.outliers > 0) {
    char share[40];
    std::snprintf(share, sizeof share, "_%g_outliers", 100 * r.noise.outliers);
    name += share;
  }
  return name;
}

std::string
fileSafe(std::string name)
{
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.')
      c = '_';
  return name;
}

namespace {

/** Styles 0 and 1 are for what comes in, 2 for the filter of this project, the others in the order of appearance. */
std::size_t
styleFor(const std::string& method, std::map<std::string, std::size_t>& styles)
{
  return styles.emplace(method, styles.size()).first->second;
}

Panel
panelOf(const std::vector<const Record*>& records, double Figures::*value, const char* title,
        std::map<std::string, std::size_t>& styles)
{
  Panel panel;
  panel.title = title;
  panel.x_label = "noise, % of the diagonal";
  panel.y_label = "1e-4 of the diagonal";
  for (const Record* r : records) {
    const std::size_t style = styleFor(r->method, styles);
    constexpr double kLeast = 1e-3;                               // of the unit: nothing but rounding lies below
    if (!(r->noise.percent > 0) || !(r->figures.*value > kLeast)) // NaN: does not apply
      continue;
    auto line = std::find_if(panel.lines.begin(), panel.lines.end(),
                             [&](const Panel::Line& l) { return l.label == r->method; });
    if (line == panel.lines.end())
      line = panel.lines.insert(line, {r->method, style, {}});
    line->points.emplace_back(r->noise.percent, r->figures.*value);
  }
  for (Panel::Line& line : panel.lines)
    std::sort(line.points.begin(), line.points.end());
  return panel;
}

} // namespace

std::vector<Chart>
drawCharts(const std::vector<Record>& records)
{
  std::vector<std::string> order;
  std::map<std::string, std::vector<const Record*>> series;
  for (const Record& r : records) {
    std::vector<const Record*>& of_one = series[seriesOf(r)];
    if (of_one.empty())
      order.push_back(seriesOf(r));
    of_one.push_back(&r);
  }
  std::map<std::string, std::size_t> styles = {{"input", 0}, {"clean", 1}, {"ours", 2}};
  std::vector<Chart> charts;
  for (const std::string& name : order) {
    std::vector<Panel> panels = {
        panelOf(series[name], &Figures::mean, "mean distance to the surface", styles),
        panelOf(series[name], &Figures::edge_coverage, "sharp edges to the nearest point (ecov)", styles)};
    panels.erase(std::remove_if(panels.begin(), panels.end(), [](const Panel& p) { return p.lines.empty(); }),
                 panels.end());
    std::string title = name;
    std::replace(title.begin(), title.end(), '_', ' ');
    if (!panels.empty())
      charts.push_back(
          {"quality_" + fileSafe(name) + ".svg",
           drawSvg(title + ", " + std::to_string(series[name].front()->size) + " points", panels)});
  }
  return charts;
}

} // namespace pcl_gpf::quality
