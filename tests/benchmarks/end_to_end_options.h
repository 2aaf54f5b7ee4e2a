// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "models.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Command line of the benchmark end_to_end.
 */
namespace pcl_gpf::benchmark_options {

constexpr const char* kUsage =
    R"(usage: end_to_end [--sizes N,N,...] [--threads N] [--repeat N] [--model block|cube|sphere] [--noise PERCENT]
                  [--iterations N] [--rounds N] [--samples RATIO] [--preset default|paper] [--csv]
Prints the median seconds of each stage, nanoseconds per pair of an input and a projected point within h/2 and iteration
(filter stage), and the peak memory above the input (result included) in bytes a point. CPU s: all threads together.
)";

struct Options {
  std::vector<std::size_t> sizes = {33490, 50629, 75053};
  unsigned threads = 0;
  unsigned repeat = 5;
  std::string model = "block";
  double noise = 1.0;
  std::string preset = "default";
  unsigned iterations = 0; ///< 0: the preset's
  int rounds = -1;         ///< of the bilateral filter; -1: the default
  double samples = 0.0;    ///< 0: the preset's
  bool csv = false;
};

template <typename T>
T
number(const std::string& text)
{
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size())
    throw std::invalid_argument("\"" + text + "\" is not a number of the kind wanted");
  return value;
}

inline Options
parse(int argc, char** argv)
{
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--csv") {
      o.csv = true;
      continue;
    }
    if (i + 1 == argc)
      throw std::invalid_argument(name + " is unknown or lacks its value");
    const std::string value = argv[++i];
    if (name == "--sizes") {
      o.sizes.clear();
      for (std::size_t begin = 0; begin <= value.size();) {
        const std::size_t end = std::min(value.find(',', begin), value.size());
        o.sizes.push_back(number<std::size_t>(value.substr(begin, end - begin)));
        begin = end + 1;
      }
    } else if (name == "--threads")
      o.threads = number<unsigned>(value);
    else if (name == "--repeat")
      o.repeat = std::max(1u, number<unsigned>(value));
    else if (name == "--model") {
      benchmark_models::makeModel(value, 0, 0.0); // refuses unknown names
      o.model = value;
    }
    else if (name == "--noise")
      o.noise = number<double>(value);
    else if (name == "--iterations")
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
