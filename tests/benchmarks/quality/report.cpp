// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"
#include "numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

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

/** The texts between commas; no value of ours holds a comma. */
std::vector<std::string>
fields(const std::string& line)
{
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    parts.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Record
parseLine(const std::string& line)
{
  constexpr std::size_t kKeys = 8;
  const std::vector<std::string> f = fields(line);
  if (f.size() != kKeys + std::size(kFigureColumns))
    throw std::invalid_argument("\"" + line + "\" has another number of fields than the heading");
  Record r;
  r.model = f[0];
  r.size = static_cast<std::size_t>(toNumber(f[1]));
  r.noise = {noiseKind(f[2]), toNumber(f[3]), toNumber(f[4]) / 100, static_cast<std::uint64_t>(toNumber(f[5]))};
  r.method = f[6];
  r.setting = f[7];
  for (std::size_t i = 0; i < std::size(kFigureColumns); ++i)
    r.figures.*kFigureColumns[i].value = f[kKeys + i].empty() ? Figures::kNone : toNumber(f[kKeys + i]);
  return r;
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
  std::string line = print("%-14s %7zu %-8s %5g %4g %-24s", r.model.c_str(), r.size, nameOf(r.noise.kind),
                           r.noise.percent, 100 * r.noise.outliers, r.method.c_str());
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
  std::string line = r.model +
                     print(",%zu,%s,%g,%g,%llu,", r.size, nameOf(r.noise.kind), r.noise.percent, 100 * r.noise.outliers,
                           static_cast<unsigned long long>(r.noise.seed)) +
                     r.method + "," + r.setting;
  for (const FigureColumn& column : kFigureColumns) {
    const double value = r.figures.*column.value;
    line += std::isnan(value) ? "," : print(",%.9g", value);
  }
  return line;
}

std::vector<Record>
readCsv(const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != csvHeading())
    throw std::runtime_error(path + " is not a file that --csv of this version wrote");
  std::vector<Record> records;
  while (std::getline(file, line))
    records.push_back(parseLine(line));
  return records;
}

} // namespace pcl_gpf::quality
