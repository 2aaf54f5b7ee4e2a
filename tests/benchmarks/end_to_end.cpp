// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark_statistics.h"
#include "end_to_end_options.h"
#include "model_cloud.h"
#include "process_memory.h"
#include "stopwatch.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/simd.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Seconds, nanoseconds a pair and memory of the whole chain on synthetic clouds; each size runs in a process of its own.
 */
namespace {

using namespace pcl_gpf;
using benchmark_models::ModelCloud;
using benchmark_models::Surroundings;
using benchmark_options::Options;
using benchmark_statistics::median;
using benchmark_timing::Seconds;
using benchmark_timing::Stopwatch;

struct Measurement {
  double points = 0, samples = 0, iterations = 0, pairs = 0;
  double normals = 0, bilateral = 0, filter = 0; ///< median seconds
  Seconds total;                                 ///< medians
  double bytes = 0;                              ///< peak above the input
};

DenoiseParameters
parametersFor(const Options& o, const ModelCloud& cloud)
{
  DenoiseParameters parameters = benchmark_options::parametersOf(o);
  if (o.neighbors > 0.0)
    benchmark_models::setBalls(parameters, Surroundings(cloud).radiusOfNeighbors(o.neighbors));
  return parameters;
}

/** Loads code and starts threads, which are no cost of the points. */
void
warmUp(const ModelCloud& cloud, const DenoiseParameters& parameters)
{
  denoise(cloud.input(1000), parameters);
}

/** Pairs of an input point and a sample within half the support radius, at the start. */
double
countPairs(const ModelCloud& cloud, const DenoiseResult& result)
{
  double support_radius = 0.0;
  for (const ParameterOrigin& origin : result.parameters)
    if (origin.name == "gpf.support_radius")
      support_radius = origin.value;
  return Surroundings(cloud).pairsWithin(0.5 * support_radius, result.sample_indices);
}

Measurement
measure(const Options& o, std::size_t size)
{
  const ModelCloud cloud(o.model, size, o.noise);
  const DenoiseParameters parameters = parametersFor(o, cloud);
  warmUp(cloud, parameters);
  Measurement m;
  std::vector<double> normals, bilateral, filter, wall, processor;
  for (unsigned run = 0; run < o.repeat; ++run) {
    const double before = benchmark_memory::resetPeak(); // of the first run: later ones find freed memory to use
    const Stopwatch watch;
    const DenoiseResult result = denoise(cloud.input(size), parameters);
    const Seconds seconds = watch.elapsed();
    wall.push_back(seconds.wall);
    processor.push_back(seconds.processor);
    normals.push_back(result.seconds_normals);
    bilateral.push_back(result.seconds_bilateral);
    filter.push_back(result.seconds_filter);
    if (run > 0)
      continue;
    m.bytes = benchmark_memory::peak() - before;
    m.points = static_cast<double>(size);
    m.samples = static_cast<double>(result.x.size());
    m.iterations = static_cast<double>(result.iterations.size());
    m.pairs = countPairs(cloud, result);
  }
  m.normals = median(normals);
  m.bilateral = median(bilateral);
  m.filter = median(filter);
  m.total = {median(wall), median(processor)};
  return m;
}

void
print(const Options& o, const Measurement& m)
{
  const double per_pair = m.pairs * m.iterations > 0 ? 1e9 * m.filter / (m.pairs * m.iterations) : 0.0;
  const char* format = o.csv ? "%s,%.0f,%.0f,%zu,%.0f,%.1f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,%.0f\n"
                             : "%-8s %9.0f %9.0f %7zu %6.0f %11.1f %9.3f %9.3f %9.3f %9.3f %9.3f %9.2f %9.0f\n";
  std::printf(format, o.model.c_str(), m.points, m.samples, resolveThreads(o.threads), m.iterations, m.pairs / m.samples, m.normals,
              m.bilateral, m.filter, m.total.wall, m.total.processor, per_pair, m.bytes / m.points);
  std::fflush(stdout);
}

void
printHeader(const Options& o)
{
  if (o.csv)
    std::puts("model,points,samples,threads,iterations,pairs_per_sample,normals_s,bilateral_s,filter_s,total_s,cpu_s,ns_per_pair,"
              "bytes_per_point");
  else {
    std::printf("%s kernels, %g %% noise, %s preset, median of %u\n", activeSimdTarget().c_str(), o.noise, o.preset.c_str(), o.repeat);
    std::printf("%-8s %9s %9s %7s %6s %11s %9s %9s %9s %9s %9s %9s %9s\n", "model", "points", "samples", "threads", "iter.",
                "pairs/samp.", "normals s", "bilat. s", "filter s", "total s", "CPU s", "ns/pair", "B/point");
  }
  std::fflush(stdout);
}

void
printSlope(const std::vector<Measurement>& measurements)
{
  const auto slope = [&](const char* name, auto seconds) {
    std::vector<double> points, values;
    for (const Measurement& m : measurements) {
      points.push_back(m.points);
      values.push_back(seconds(m));
    }
    std::printf(" %s %.3f", name, benchmark_statistics::logarithmicSlope(points, values));
  };
  std::printf("# slope of log seconds over log points:");
  slope("total", [](const Measurement& m) { return m.total.wall; });
  slope("CPU", [](const Measurement& m) { return m.total.processor; });
  slope("normals", [](const Measurement& m) { return m.normals; });
  slope("bilateral", [](const Measurement& m) { return m.bilateral; });
  slope("filter", [](const Measurement& m) { return m.filter; });
  std::puts("");
}

struct ThreadComparison {
  Seconds one, many; ///< medians
};

ThreadComparison
compareThreads(const Options& o, std::size_t size)
{
  const ModelCloud cloud(o.model, size, o.noise);
  DenoiseParameters parameters = parametersFor(o, cloud);
  warmUp(cloud, parameters);
  std::vector<double> wall[2], processor[2];
  for (unsigned run = 0; run < 2 * o.repeat; ++run) {
    parameters.number_of_threads = run % 2 == 0 ? 1 : o.threads;
    const Stopwatch watch;
    denoise(cloud.input(size), parameters);
    const Seconds seconds = watch.elapsed();
    wall[run % 2].push_back(seconds.wall);
    processor[run % 2].push_back(seconds.processor);
  }
  return {{median(wall[0]), median(processor[0])}, {median(wall[1]), median(processor[1])}};
}

void
printComparison(const Options& o, std::size_t size, const ThreadComparison& c)
{
  std::printf("# %zu points: 1 thread %.3f s (CPU %.3f), %zu threads %.3f s (CPU %.3f): %.2f times as fast, %.2f times the CPU\n", size,
              c.one.wall, c.one.processor, resolveThreads(o.threads), c.many.wall, c.many.processor, c.one.wall / c.many.wall,
              c.many.processor / c.one.processor);
  std::fflush(stdout);
}

void
run(const Options& o)
{
  using benchmark_memory::inChildProcess;
  printHeader(o);
  std::vector<Measurement> measurements;
  for (const std::size_t size : o.sizes) {
    measurements.push_back(inChildProcess<Measurement>([&] { return measure(o, size); }));
    print(o, measurements.back());
  }
  if (o.slope)
    printSlope(measurements);
  if (o.threads_compare)
    for (const std::size_t size : o.sizes)
      printComparison(o, size, inChildProcess<ThreadComparison>([&] { return compareThreads(o, size); }));
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    run(benchmark_options::parse(argc, argv));
    return 0;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "end_to_end: %s\n%s", e.what(), benchmark_options::kUsage);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "end_to_end: %s\n", e.what());
    return 1;
  }
}
