// SPDX-License-Identifier: BSD-3-Clause
#include "experiment.h"
#include "options.h"
#include "report.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

/** \file
 * \brief Measures the quality of filters on clouds whose surface is known.
 */
namespace {

using namespace pcl_gpf::quality;

int
run(const Options& options)
{
  std::ofstream csv;
  if (!options.csv.empty()) {
    csv.open(options.csv);
    csv << csvHeading() << std::endl;
    if (!csv)
      throw std::runtime_error(options.csv + " cannot be written");
  }
  std::puts(tableHeading().c_str());
  runExperiment(options, [&](const Record& record) {
    std::puts(tableLine(record).c_str());
    std::fflush(stdout);
    if (csv.is_open())
      csv << csvLine(record) << std::endl;
  });
  if (csv.is_open() && !csv)
    throw std::runtime_error(options.csv + " could not be written completely");
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    const Options options = parseOptions({argv + 1, argv + argc});
    if (options.help) {
      std::fputs(usage().c_str(), stdout);
      return 0;
    }
    return run(options);
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "quality: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "quality: %s\n", e.what());
    return 1;
  }
}
