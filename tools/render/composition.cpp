// SPDX-License-Identifier: BSD-3-Clause
#include "composition.h"

#include "../console.h"
#include "color_map.h"
#include "text.h"

#include <algorithm>

namespace pcl_gpf {

namespace {

constexpr std::size_t kGap = 6;
constexpr std::size_t kStripHeight = kTextHeight + 14;
constexpr Color kLine{0.82f, 0.83f, 0.85f};

/** The end of a text that fits in a width: of a path, the end tells most. */
std::string
fitted(const std::string& text, std::size_t width)
{
  std::size_t begin = 0;
  while (begin < text.size() && textWidth(text.substr(begin)) > width)
    ++begin;
  return text.substr(begin);
}

} // namespace

Image
composeSideBySide(const std::vector<Image>& panels, const std::vector<std::string>& labels)
{
  const bool labelled = std::any_of(labels.begin(), labels.end(), [](const std::string& label) { return !label.empty(); });
  const std::size_t strip = labelled ? kStripHeight : 0;
  const std::size_t width = panels[0].width;
  Image image(panels.size() * (width + kGap) - kGap, panels[0].height + strip, kLine);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t left = i * (width + kGap);
    paste(panels[i], left, strip, image);
    if (!labelled)
      continue;
    paste(Image(width, strip, kPaper), left, 0, image);
    const std::string label = fitted(labels[i], width);
    drawText(label, left + (width - textWidth(label)) / 2, (strip - kTextHeight) / 2, kInk, image);
  }
  return image;
}

Image
withLegend(const Image& image, const std::string& title, const ValueRange& range)
{
  Image result(image.width, image.height + kStripHeight, kPaper);
  paste(image, 0, 0, result);
  const std::size_t top = image.height + (kStripHeight - kTextHeight) / 2;
  const std::size_t bar_width = image.width / 3;
  const std::size_t bar_left = (image.width - bar_width) / 2;
  for (std::size_t column = 0; column < bar_width; ++column)
    for (std::size_t row = top; row < top + kTextHeight; ++row)
      result.at(bar_left + column, row) = mapColor(static_cast<double>(column) / static_cast<double>(bar_width - 1));
  const std::string low = fitted(title + " " + shortNumber(range.low), bar_left - std::min(bar_left, kGap));
  drawText(low, bar_left - std::min(bar_left, textWidth(low) + kGap), top, kInk, result);
  drawText(shortNumber(range.high), bar_left + bar_width + kGap, top, kInk, result);
  return result;
}

} // namespace pcl_gpf
