// SPDX-License-Identifier: BSD-3-Clause
#include "contestants.h"
#include "peers_options.h"

#include "benchmarks/benchmark_statistics.h"
#include "benchmarks/model_cloud.h"
#include "benchmarks/stopwatch.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/simd.h>

#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Our whole chain beside filters of PCL and CGAL: the same cloud, the same process, run in turn with the same number of threads.
 */
namespace {

using namespace pcl_gpf;
using namespace pcl_gpf::benchmark_peers;
using benchmark_models::ModelCloud;
using benchmark_statistics::median;
using benchmark_timing::Seconds;
using benchmark_timing::Stopwatch;

/** All runs of one method on one cloud. */
struct Record {
  std::vector<double> wall, processor;
  std::vector<std::vector<double>> stages;
  Outcome last;
  double used = 0; ///< wall seconds

  void
  add(const Seconds& seconds, Outcome outcome)
  {
    wall.push_back(seconds.wall);
    processor.push_back(seconds.processor);
    used += seconds.wall;
    stages.resize(outcome.stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i)
      stages[i].push_back(outcome.stages[i].second);
    last = std::move(outcome);
  }
  Seconds medians() const { return {median(wall), median(processor)}; }
};

/** Loads code and starts threads, which are no cost of the points. */
void
warmUp(PeersOptions options)
{
  options.wlop_iterations = 1;
  const ModelCloud small(options.model, 1000, options.noise);
  for (const Contestant& contestant : contestants(options, small))
    contestant.run();
}

std::vector<Record>
runInTurn(const PeersOptions& options, const std::vector<Contestant>& methods)
{
  std::vector<Record> records(methods.size());
  for (unsigned round = 0; round < options.repeat; ++round)
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (options.time_limit > 0.0 && records[i].used >= options.time_limit)
        continue;
      const Stopwatch watch;
      Outcome outcome = methods[i].run();
      records[i].add(watch.elapsed(), std::move(outcome));
    }
  return records;
}

/** The first two are ours. Ratios: ours / method, below 1 where ours is faster. */
void
printTable(const PeersOptions& options, const std::vector<Contestant>& methods, const std::vector<Record>& records)
{
  std::printf("%-15s %9s %5s %9s %9s | %9s %9s | %9s %9s | %s\n", "method", "points", "runs", "wall s", "CPU s", "ours/it", "by CPU",
              "default/it", "by CPU", "parameters");
  const Seconds ours = records[0].medians(), ours_default = records[1].medians();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Seconds m = records[i].medians();
    std::printf("%-15s %9zu %5zu %9.3f %9.3f | %9.4f %9.4f | %9.4f %9.4f | %s\n", methods[i].name.c_str(), records[i].last.points,
                records[i].wall.size(), m.wall, m.processor, ours.wall / m.wall, ours.processor / m.processor,
                ours_default.wall / m.wall, ours_default.processor / m.processor, methods[i].parameters.c_str());
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (records[i].stages.empty())
      continue;
    std::printf("%s, wall s:", methods[i].name.c_str());
    for (std::size_t k = 0; k < records[i].stages.size(); ++k)
      std::printf(" %s %.3f", records[i].last.stages[k].first.c_str(), median(records[i].stages[k]));
    std::puts("");
  }
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (records[i].wall.size() < options.repeat)
      std::printf("%s was stopped after %zu of %u runs by the time limit of %g s\n", methods[i].name.c_str(), records[i].wall.size(),
                  options.repeat, options.time_limit);
}

void
run(const PeersOptions& options)
{
  warmUp(options);
  for (const std::size_t size : options.sizes) {
    const ModelCloud cloud(options.model, size, options.noise);
    const std::vector<Contestant> methods = contestants(options, cloud);
    std::printf("%s, %zu points, %g %% noise, %zu threads, %s kernels, medians of %u in turn\n", options.model.c_str(), size,
                options.noise, resolveThreads(options.threads), activeSimdTarget().c_str(), options.repeat);
    std::fflush(stdout);
    printTable(options, methods, runInTurn(options, methods));
    std::puts("");
    std::fflush(stdout);
  }
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "peers: %s\n%s", e.what(), kUsage);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "peers: %s\n", e.what());
    return 1;
  }
}
