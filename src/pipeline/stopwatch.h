// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace pcl_gpf {

/** Seconds of the stages of a chain. */
class Stopwatch {
public:
  /** Since it was made or since the last lap(). */
  double
  elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
  }

  double
  lap()
  {
    const double seconds = elapsed();
    last_ = std::chrono::steady_clock::now();
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace pcl_gpf
