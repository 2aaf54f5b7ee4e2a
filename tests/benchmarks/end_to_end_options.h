// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud_options.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <stdexcept>
#include <string>

/** \file
 * \brief Command line of the benchmark end_to_end.
 */
namespace pcl_gpf::benchmark_options {

constexpr const char* kUsage =
    R"(usage: end_to_end [--sizes N,N,...] [--threads N] [--repeat N] [--model block|cube|sphere] [--noise PERCENT]
                  [--iterations N] [--rounds N] [--samples RATIO] [--preset default|paper] [--neighbors K]
                  [--slope] [--threads-compare] [--csv]
Prints the median seconds of each stage, nanoseconds per pair of an input and a projected point within h/2 and iteration
(filter stage), and the peak memory above the input (result included) in bytes a point. CPU s: all threads together.
  --neighbors K      every ball of the chain gets the radius that holds K points on average, at each size anew
  --slope            then the slope of log seconds over log points (least squares over all sizes)
  --threads-compare  then, for each size, one thread against --threads, run in turn
)";

struct Options : CloudOptions {
  std::string preset = "default";
  unsigned iterations = 0; ///< 0: the preset's
  int rounds = -1;         ///< of the bilateral filter; -1: the default
  double samples = 0.0;    ///< 0: the preset's
  bool slope = false;
  bool threads_compare = false;
  bool csv = false;

  Options() { sizes = {33490, 50629, 75053}; } // neighbors 0: estimated lengths
};

/** \return whether `name` is an option without a value */
inline bool
setFlag(Options& o, const std::string& name)
{
  bool* const flag = name == "--csv"               ? &o.csv
                     : name == "--slope"           ? &o.slope
                     : name == "--threads-compare" ? &o.threads_compare
                                                   : nullptr;
  if (flag)
    *flag = true;
  return flag != nullptr;
}

inline void
setValue(Options& o, const std::string& name, const std::string& value)
{
  if (setCloudValue(o, name, value, 1))
    return;
  if (name == "--iterations")
    o.iterations = number<unsigned>(value);
  else if (name == "--rounds")
    o.rounds = number<int>(value);
  else if (name == "--samples")
    o.samples = number<double>(value);
  else if (name == "--preset" && (value == "default" || value == "paper"))
    o.preset = value;
  else
    throw std::invalid_argument("unknown option or value: " + name + " " + value);
}

inline Options
parse(int argc, char** argv)
{
  Options o;
  forEachOption(
      argc, argv, [&](const std::string& name) { return setFlag(o, name); },
      [&](const std::string& name, const std::string& value) { setValue(o, name, value); });
  if (o.slope && std::all_of(o.sizes.begin(), o.sizes.end(), [&](std::size_t size) { return size == o.sizes.front(); }))
    throw std::invalid_argument("--slope needs at least two different sizes");
  if (o.threads_compare && resolveThreads(o.threads) < 2)
    throw std::invalid_argument("--threads-compare needs at least two threads");
  return o;
}

inline DenoiseParameters
parametersOf(const Options& o)
{
  DenoiseParameters p;
  if (o.preset == "paper")
    p.gpf = GPFParameters::paper();
  if (o.iterations > 0) {
    p.gpf.maximum_iterations = o.iterations;
    p.gpf.convergence_threshold = 0.0; // exactly as many
  }
  if (o.samples > 0.0)
    p.gpf.sample_ratio = o.samples;
  if (o.rounds >= 0)
    p.bilateral.iterations = static_cast<unsigned>(o.rounds);
  p.number_of_threads = o.threads;
  return p;
}

} // namespace pcl_gpf::benchmark_options
