// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <ctime>

namespace pcl_gpf::benchmark_timing {

/** \brief Seconds of a piece of work. */
struct Seconds {
  double wall = 0;
  double processor = 0; ///< of all threads together
};

/** \brief Runs from its construction. */
class Stopwatch {
public:
  Seconds
  elapsed() const
  {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC};
  }

private:
  std::clock_t processor_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

} // namespace pcl_gpf::benchmark_timing
