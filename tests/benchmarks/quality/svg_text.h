// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace pcl_gpf::quality {

/** \brief printf into a string; up to 399 characters. */
template <typename... Values>
std::string
svgPrint(const char* format, Values... values)
{
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/** \brief A text element. \param[in] more further attributes */
inline std::string
svgText(double x, double y, const std::string& what, const char* anchor = "middle", const char* more = "")
{
  std::string escaped;
  for (const char c : what)
    escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
  return svgPrint("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, more) + escaped + "</text>\n";
}

/** \brief What a document of this size begins with: element, font, white ground, title. */
inline std::string
svgHead(double width, double height, const std::string& title)
{
  return svgPrint("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
                  "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222\">\n",
                  width, height, width, height) +
         svgPrint("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", width, height) +
         svgText(0.5 * width, 24, title, "middle", "font-size=\"15\"");
}

} // namespace pcl_gpf::quality
