// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace pcl_gpf {

/** \brief Seconds since it was made or since the last lap(). */
class Stopwatch {
public:
  double
  lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    begin_ = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace pcl_gpf
