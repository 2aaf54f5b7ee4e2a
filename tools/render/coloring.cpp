// SPDX-License-Identifier: BSD-3-Clause
#include "coloring.h"

#include <pcl_gpf/core/errors.h>

#include <utility>

namespace pcl_gpf {

namespace {

void
takeColorsOfFiles(const std::vector<PictureCloud>& clouds, Coloring& coloring)
{
  bool any = false;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    std::vector<Color> colors = colorsInFile(clouds[i]);
    if (colors.empty())
      continue;
    coloring.colors[i] = std::move(colors);
    any = true;
  }
  if (!any)
    throw UnsuitableData("no cloud has colours (rgb, rgba, or red green blue)");
}

void
mapField(const std::vector<PictureCloud>& clouds, const ColoringRequest& request, Coloring& coloring)
{
  std::vector<std::vector<double>> values;
  std::vector<double> all;
  for (const PictureCloud& cloud : clouds) {
    values.push_back(fieldValues(cloud, request.mode));
    all.insert(all.end(), values.back().begin(), values.back().end());
  }
  if (all.empty())
    throw UnsuitableData("no cloud has the field '" + request.mode + "'");
  ValueRange range = typicalRange(std::move(all));
  range.low = request.low.value_or(range.low);
  range.high = request.high.value_or(range.high);
  for (std::size_t i = 0; i < clouds.size(); ++i)
    if (!values[i].empty())
      coloring.colors[i] = mapColors(values[i], range);
  coloring.range = range;
}

} // namespace

Coloring
colorClouds(const std::vector<PictureCloud>& clouds, const ColoringRequest& request)
{
  Coloring coloring;
  for (const PictureCloud& cloud : clouds)
    coloring.colors.emplace_back(cloud.points.size(), request.plain);
  if (request.mode == "rgb")
    takeColorsOfFiles(clouds, coloring);
  else if (request.mode != "shade")
    mapField(clouds, request, coloring);
  return coloring;
}

} // namespace pcl_gpf
