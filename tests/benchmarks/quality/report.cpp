// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf::quality {

namespace {

template <typename... Values>
std::string
print(const char* format, Values... values)
{
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/** Widths of the columns, by what the widest usual figure needs. */
std::size_t
widthOf(const FigureColumn& column)
{
  return std::max<std::size_t>(std::string(column.name).size(), 8);
}

std::string
right(const std::string& text, std::size_t width)
{
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

/** Quoted when it holds a comma. */
std::string
csvText(const std::string& text)
{
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

} // namespace

std::string
tableHeading()
{
  std::string line = print("%-14s %7s %-8s %5s %4s %-24s", "model", "size", "noise", "%", "out%", "method");
  for (const FigureColumn& column : kFigureColumns)
    line += " " + right(column.name, widthOf(column));
  return line;
}

std::string
tableLine(const Record& r)
{
  std::string line = print("%-14s %7zu %-8s %5g %4g %-24s", r.model.c_str(), r.size, nameOf(r.noise.kind), r.noise.percent,
                           100 * r.noise.outliers, r.method.c_str());
  for (const FigureColumn& column : kFigureColumns) {
    const double value = r.figures.*column.value;
    line += " " + right(std::isnan(value) ? "-" : print(column.format, value), widthOf(column));
  }
  return r.setting.empty() ? line : line + "  " + r.setting;
}

std::string
csvHeading()
{
  std::string line = "model,size,kind,noise_percent,outlier_percent,seed,method,setting";
  for (const FigureColumn& column : kFigureColumns)
    line += std::string(",") + column.name;
  return line;
}

std::string
csvLine(const Record& r)
{
  std::string line = csvText(r.model) + print(",%zu,%s,%g,%g,%llu,", r.size, nameOf(r.noise.kind), r.noise.percent,
                                              100 * r.noise.outliers, static_cast<unsigned long long>(r.noise.seed)) +
                     csvText(r.method) + "," + csvText(r.setting);
  for (const FigureColumn& column : kFigureColumns) {
    const double value = r.figures.*column.value;
    line += std::isnan(value) ? "," : print(",%.9g", value);
  }
  return line;
}

} // namespace pcl_gpf::quality
