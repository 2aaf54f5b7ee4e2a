// SPDX-License-Identifier: BSD-3-Clause
#include "bar_chart.h"
#include "numbers.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

/** \file
 * \brief Draws numbers that come on the command line as bars.
 */
namespace {

using namespace pcl_gpf::quality;

constexpr const char* kUsage =
    "usage: bars FILE.svg TITLE --panel TITLE LABEL=VALUE ... [--panel TITLE LABEL=VALUE ...]\n";

BarPanel::Bar
parseBar(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos)
    throw std::invalid_argument("\"" + text + "\" is not LABEL=VALUE");
  const double value = toNumber(text.substr(equals + 1));
  if (!(value >= 0) || std::isinf(value))
    throw std::invalid_argument("\"" + text + "\": a bar is finite and not below 0");
  return {text.substr(0, equals), value};
}

std::vector<BarPanel>
parsePanels(const std::vector<std::string>& arguments)
{
  std::vector<BarPanel> panels;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (arguments[i] == "--panel" && i + 1 < arguments.size())
      panels.push_back({arguments[++i], {}});
    else if (panels.empty())
      throw std::invalid_argument("the first argument behind the title must be --panel");
    else
      panels.back().bars.push_back(parseBar(arguments[i]));
  if (panels.empty())
    throw std::invalid_argument("there is no --panel");
  return panels;
}

} // namespace

int
main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 2) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    const std::string svg = drawBars(arguments[1], parsePanels({arguments.begin() + 2, arguments.end()}));
    std::ofstream file(arguments[0]);
    file << svg << std::flush;
    if (!file)
      throw std::runtime_error(arguments[0] + " cannot be written");
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "bars: %s\n%s", e.what(), kUsage);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bars: %s\n", e.what());
    return 1;
  }
  return 0;
}
