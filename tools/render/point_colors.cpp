// SPDX-License-Identifier: BSD-3-Clause
#include "point_colors.h"

#include "color_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_gpf {

namespace {

/** PCD holds a colour as the bits 0xAARRGGBB of an integer or of a float. */
Color
unpackColor(const CloudFile& cloud, std::size_t row, int field)
{
  const double value = cloud.value(row, field);
  std::uint32_t bits = 0;
  if (cloud.fields[static_cast<std::size_t>(field)].type == FieldType::Float32) {
    const auto packed = static_cast<float>(value);
    std::memcpy(&bits, &packed, sizeof(bits));
  } else {
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  }
  const auto channel = [&](unsigned shift) { return static_cast<float>(bits >> shift & 0xffu) / 255.0f; };
  return {channel(16), channel(8), channel(0)};
}

/** What the full channel is in a field of this type. */
double
fullChannel(const CloudFile& cloud, int field)
{
  const FieldType type = cloud.fields[static_cast<std::size_t>(field)].type;
  if (type == FieldType::UInt16)
    return 65535;
  if (type != FieldType::Float32 && type != FieldType::Float64)
    return 255;
  const std::vector<double> values = cloud.column(field);
  return *std::max_element(values.begin(), values.end()) > 1 ? 255 : 1;
}

} // namespace

std::vector<Color>
colorsInFile(const PictureCloud& cloud)
{
  std::vector<Color> colors(cloud.rows.size());
  for (const char* name : {"rgb", "rgba"}) {
    const int field = cloud.file.findField(name);
    if (field < 0)
      continue;
    for (std::size_t i = 0; i < colors.size(); ++i)
      colors[i] = unpackColor(cloud.file, cloud.rows[i], field);
    return colors;
  }
  const char* const names[3] = {"red", "green", "blue"};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const int field = cloud.file.findField(names[channel]);
    if (field < 0)
      return {};
    const double full = fullChannel(cloud.file, field);
    for (std::size_t i = 0; i < colors.size(); ++i)
      colors[i][channel] = static_cast<float>(cloud.file.value(cloud.rows[i], field) / full);
  }
  return colors;
}

std::vector<double>
fieldValues(const PictureCloud& cloud, const std::string& field)
{
  const int index = cloud.file.findField(field);
  std::vector<double> values;
  if (index >= 0)
    for (const std::uint32_t row : cloud.rows)
      values.push_back(cloud.file.value(row, index));
  return values;
}

ValueRange
typicalRange(std::vector<double> values)
{
  values.erase(std::remove_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }), values.end());
  if (values.empty())
    return {};
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 50);
  ValueRange range;
  std::nth_element(values.begin(), values.begin() + cut, values.end());
  range.low = values[static_cast<std::size_t>(cut)];
  std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
  range.high = *(values.end() - 1 - cut);
  return range;
}

std::vector<Color>
mapColors(const std::vector<double>& values, const ValueRange& range)
{
  const double width = range.high - range.low;
  std::vector<Color> colors(values.size());
  std::transform(values.begin(), values.end(), colors.begin(),
                 [&](double value) { return mapColor(width > 0 ? (value - range.low) / width : value - range.low); });
  return colors;
}

} // namespace pcl_gpf
