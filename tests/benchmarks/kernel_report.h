// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmark_statistics.h"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace pcl_gpf::benchmark_report {

/** \brief Google Benchmark's console, then one line a kernel: the real loop beside the ideal one. */
class RatioReporter : public benchmark::ConsoleReporter {
public:
  /** \brief Name under which the ideal loop of a kernel is registered. */
  static std::string
  idealName(const std::string& kernel)
  {
    return "ideal/" + kernel;
  }

  /** \brief Announces a kernel. \param[in] operations floating-point operations a pair */
  void
  add(const std::string& kernel, int operations)
  {
    kernels_.push_back({kernel, operations});
  }

  void
  ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs) {
      const auto pair = run.counters.find("pair");
      if (pair != run.counters.end() && (run.run_type == Run::RT_Iteration || run.aggregate_name == "median"))
        nanoseconds_[run.run_name.function_name].push_back(1e9 * pair->second);
    }
    ConsoleReporter::ReportRuns(runs);
  }

  void
  Finalize() override
  {
    ConsoleReporter::Finalize();
    std::printf("\n%-34s %6s %10s %10s %12s %14s %14s\n", "kernel, medians", "flop", "ns/pair", "ideal", "real/ideal",
                "GFLOP/s", "ideal GFLOP/s");
    for (const auto& [kernel, operations] : kernels_) {
      const auto real = nanoseconds_.find(kernel), ideal = nanoseconds_.find(idealName(kernel));
      if (real == nanoseconds_.end() || ideal == nanoseconds_.end())
        continue; // filtered out
      const double real_ns = benchmark_statistics::median(real->second), ideal_ns = benchmark_statistics::median(ideal->second);
      std::printf("%-34s %6d %10.3f %10.3f %12.2f %14.1f %14.1f\n", kernel.c_str(), operations, real_ns, ideal_ns,
                  real_ns / ideal_ns, operations / real_ns, operations / ideal_ns);
    }
  }

private:
  struct Kernel {
    std::string name;
    int operations;
  };
  std::vector<Kernel> kernels_;
  std::map<std::string, std::vector<double>> nanoseconds_; ///< per in-radius pair and run
};

} // namespace pcl_gpf::benchmark_report
