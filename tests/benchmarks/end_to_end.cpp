// SPDX-License-Identifier: BSD-3-Clause
#include "end_to_end_options.h"
#include "models.h"
#include "process_memory.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/simd.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Seconds, nanoseconds a pair and memory of the whole chain on synthetic clouds; each size runs in a process of its own.
 */
namespace {

using namespace pcl_gpf;
using benchmark_options::Options;

struct Measurement {
  double points = 0, samples = 0, iterations = 0, pairs = 0;
  double normals = 0, bilateral = 0, filter = 0, total = 0; ///< median seconds
  double processor = 0;                                     ///< median seconds of all threads together
  double bytes = 0;                                         ///< peak above the input
};

/** Pairs of an input point and a sample within half the support radius, at the start. */
double
countPairs(const std::vector<double> (&axes)[3], const DenoiseResult& result)
{
  BoundingBox box;
  for (std::size_t i = 0; i < axes[0].size(); ++i)
    box.add(axes[0][i], axes[1][i], axes[2][i]);
  const LocalFrame frame = localFrame(box);
  SoaBuffer points(axes[0].size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.x[i] = frame.toLocal(axes[0][i], 0);
    points.y[i] = frame.toLocal(axes[1][i], 1);
    points.z[i] = frame.toLocal(axes[2][i], 2);
  }
  double radius = 0.0;
  for (const ParameterOrigin& origin : result.parameters)
    if (origin.name == "gpf.support_radius")
      radius = 0.5 * frame.lengthToLocal(origin.value);
  const PointIndex index(points.view());
  const PointsView sorted = index.sorted();
  double pairs = 0.0;
  std::vector<Run> runs;
  for (const std::uint32_t s : result.sample_indices) {
    const std::array<float, 3> q = {points.x[s], points.y[s], points.z[s]};
    runs.clear();
    index.tree().collectRuns({q, q}, static_cast<float>(radius), runs);
    std::size_t within = 0;
    for (const Run& run : runs)
      for (std::size_t j = run.begin; j < run.end; ++j) {
        const float dx = sorted.x[j] - q[0], dy = sorted.y[j] - q[1], dz = sorted.z[j] - q[2];
        within += static_cast<double>(dx * dx + dy * dy + dz * dz) < radius * radius;
      }
    pairs += static_cast<double>(within);
  }
  return pairs;
}

double
median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Measurement
measure(const Options& o, std::size_t size)
{
  std::vector<double> axes[3];
  for (auto& axis : axes)
    axis.reserve(size);
  for (const test::Vector3& p : benchmark_models::makeModel(o.model, size, o.noise).points)
    for (std::size_t axis = 0; axis < 3; ++axis)
      axes[axis].push_back(p[axis]);
  DenoiseInput input;
  input.x = axes[0].data();
  input.y = axes[1].data();
  input.z = axes[2].data();
  input.size = size;
  const DenoiseParameters parameters = benchmark_options::parametersOf(o);

  DenoiseInput few = input; // loads code and starts threads, which are no cost of the points
  few.size = std::min<std::size_t>(size, 1000);
  denoise(few, parameters);

  Measurement m;
  std::vector<double> normals, bilateral, filter, total, processor;
  for (unsigned run = 0; run < o.repeat; ++run) {
    const double before = benchmark_memory::resetPeak(); // of the first run: later ones find freed memory to use
    const std::clock_t processor_start = std::clock();
    const auto start = std::chrono::steady_clock::now();
    const DenoiseResult result = denoise(input, parameters);
    total.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    processor.push_back(static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC);
    normals.push_back(result.seconds_normals);
    bilateral.push_back(result.seconds_bilateral);
    filter.push_back(result.seconds_filter);
    if (run > 0)
      continue;
    m.bytes = benchmark_memory::peak() - before;
    m.points = static_cast<double>(size);
    m.samples = static_cast<double>(result.x.size());
    m.iterations = static_cast<double>(result.iterations.size());
    m.pairs = countPairs(axes, result);
  }
  m.normals = median(normals);
  m.bilateral = median(bilateral);
  m.filter = median(filter);
  m.total = median(total);
  m.processor = median(processor);
  return m;
}

void
print(const Options& o, const Measurement& m)
{
  const double per_pair = m.pairs * m.iterations > 0 ? 1e9 * m.filter / (m.pairs * m.iterations) : 0.0;
  const char* format = o.csv ? "%s,%.0f,%.0f,%zu,%.0f,%.1f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,%.0f\n"
                             : "%-8s %9.0f %9.0f %7zu %6.0f %11.1f %9.3f %9.3f %9.3f %9.3f %9.3f %9.2f %9.0f\n";
  std::printf(format, o.model.c_str(), m.points, m.samples, resolveThreads(o.threads), m.iterations, m.pairs / m.samples, m.normals,
              m.bilateral, m.filter, m.total, m.processor, per_pair, m.bytes / m.points);
  std::fflush(stdout);
}

} // namespace

int
main(int argc, char** argv)
{
  try {
    const Options options = benchmark_options::parse(argc, argv);
    if (options.csv)
      std::puts("model,points,samples,threads,iterations,pairs_per_sample,normals_s,bilateral_s,filter_s,total_s,cpu_s,ns_per_pair,"
                "bytes_per_point");
    else {
      std::printf("%s kernels, %g %% noise, %s preset, median of %u\n", activeSimdTarget().c_str(), options.noise,
                  options.preset.c_str(), options.repeat);
      std::printf("%-8s %9s %9s %7s %6s %11s %9s %9s %9s %9s %9s %9s %9s\n", "model", "points", "samples", "threads", "iter.",
                  "pairs/samp.", "normals s", "bilat. s", "filter s", "total s", "CPU s", "ns/pair", "B/point");
    }
    std::fflush(stdout);
    for (const std::size_t size : options.sizes)
      print(options, benchmark_memory::inChildProcess<Measurement>([&] { return measure(options, size); }));
    return 0;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "end_to_end: %s\n%s", e.what(), benchmark_options::kUsage);
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "end_to_end: %s\n", e.what());
    return 1;
  }
}
