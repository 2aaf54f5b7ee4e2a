// SPDX-License-Identifier: BSD-3-Clause
#include "noise_estimates.h"
#include "stopwatch.h"

#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <cmath>
#include <cstdio>

namespace pcl_gpf::quality {

namespace {

constexpr double kTolerance = 0.2;

double
noiseAlongNormals(const NoisyCloud& cloud)
{
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.is_outlier[i] != 0)
      continue;
    const double height = dot(subtract(cloud.points[i], cloud.clean[i].point), cloud.clean[i].normal);
    squares += height * height;
    ++count;
  }
  return std::sqrt(squares / count);
}

} // namespace

NoiseEstimate
estimateNoiseOf(const NoisyCloud& cloud, unsigned threads)
{
  NoiseEstimate result;
  result.truth = noiseAlongNormals(cloud);
  BoundingBox box;
  for (const Position& p : cloud.points)
    box.add(p[0], p[1], p[2]);
  const LocalFrame frame = localFrame(box);
  SoaBuffer points(cloud.points.size());
  AlignedArray<float>* const axes[3] = {&points.x, &points.y, &points.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      (*axes[axis])[i] = frame.toLocal(cloud.points[i][axis], axis);
  const PointIndex index(points.view(), threads);
  const Stopwatch watch;
  result.estimate = frame.lengthToWorld(measureScale(index, threads).noise);
  MethodResult times;
  watch.writeTo(times);
  result.seconds = times.processor_seconds;
  return result;
}

void
tabulateNoiseEstimates(const Options& options, const std::function<void(const std::string&)>& report)
{
  char text[80];
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
    return std::string(text);
  };
  std::string heading = print("%-28s %7s %-9s %8s", "model", "points", "noise", "outliers");
  for (const double percent : options.noises)
    heading += print(" %6g %%", percent);
  report(heading + "    cpu_s");
  int cells = 0, wrong = 0;
  for (const std::string& name : options.models)
    for (const std::size_t size : options.sizes) {
      const Model model = makeModel(name, size);
      for (const NoiseKind kind : options.kinds)
        for (const double outliers : options.outliers) {
          std::string line = print("%-28s %7zu %-9s %6g %%", name.c_str(), size, nameOf(kind), 100 * outliers);
          double seconds = 0;
          for (const double percent : options.noises) {
            const NoiseEstimate found =
                estimateNoiseOf(makeNoisyCloud(model, size, {kind, percent, outliers, options.seed}), options.threads);
            const bool within = std::abs(found.ratio() - 1) <= kTolerance;
            line += print(" %7.3f%c", found.ratio(), within ? ' ' : '*');
            ++cells;
            wrong += !within;
            seconds += found.seconds;
          }
          report(line + print(" %8.3f", seconds));
        }
    }
  report(print("%d of %d estimates are further than %g %% from the truth (*)", wrong, cells, 100 * kTolerance));
}

} // namespace pcl_gpf::quality
