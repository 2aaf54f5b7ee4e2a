// SPDX-License-Identifier: BSD-3-Clause
#include "charts.h"
#include "experiment.h"
#include "noise_estimates.h"
#include "options.h"
#include "peer_comparison.h"
#include "report.h"
#include "targets.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

/** \file
 * \brief Measures the quality of filters on clouds whose surface is known.
 */
namespace {

using namespace pcl_gpf::quality;

/** Lines of CSV as they come; nothing when no file is wanted. */
class CsvFile {
public:
  explicit CsvFile(const std::string& path)
      : path_(path)
  {
    if (!path.empty())
      file_.open(path);
    write(csvHeading());
  }
  void
  write(const std::string& line)
  {
    if (path_.empty())
      return;
    file_ << line << std::endl; // flushed, so that a run that is stopped leaves what it has
    if (!file_)
      throw std::runtime_error(path_ + " cannot be written");
  }

private:
  std::string path_;
  std::ofstream file_;
};

void
writeCharts(const std::string& folder, const std::vector<Record>& records)
{
  std::filesystem::create_directories(folder);
  for (const Chart& chart : drawCharts(records)) {
    const std::filesystem::path path = std::filesystem::path(folder) / chart.file_name;
    std::ofstream file(path);
    file << chart.svg << std::flush;
    if (!file)
      throw std::runtime_error(path.string() + " cannot be written");
    std::printf("%s\n", path.c_str());
  }
}

int
run(const Options& options)
{
  if (options.noise_estimates) {
    tabulateNoiseEstimates(options, [](const std::string& line) {
      std::puts(line.c_str());
      std::fflush(stdout);
    });
    return 0;
  }
  CsvFile csv(options.csv);
  const auto report = [&](const Record& record) {
    std::puts(tableLine(record).c_str());
    std::fflush(stdout);
    csv.write(csvLine(record));
  };
  std::puts(tableHeading().c_str());
  if (options.targets) {
    const std::vector<TargetResult> results = runTargets(options, report);
    std::printf("\n%s", targetTable(results).c_str());
    return std::all_of(results.begin(), results.end(), [](const TargetResult& r) { return r.holds(); }) ? 0 : 1;
  }
  const std::vector<Record> records = runExperiment(options, report);
  if (!options.svg_dir.empty())
    writeCharts(options.svg_dir, records);
  if (!options.against_peers)
    return 0;
  const std::vector<PeerComparison> comparisons = compareWithPeers(records);
  if (comparisons.empty())
    throw std::invalid_argument("--against-peers: no cloud has a method \"ours...\" and a tuned peer (\"...-best\")");
  std::printf("\n%s", peerTable(comparisons).c_str());
  return std::all_of(comparisons.begin(), comparisons.end(), [](const PeerComparison& c) { return c.holds(); }) ? 0 : 1;
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
