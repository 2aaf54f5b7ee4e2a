// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "methods.h"

#include <chrono>
#include <ctime>

namespace pcl_gpf::quality {

/** \brief Wall clock and processor time of all threads since it was made. */
class Stopwatch {
public:
  void
  writeTo(MethodResult& result) const
  {
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    result.processor_seconds = static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC;
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t processor_start_ = std::clock();
};

} // namespace pcl_gpf::quality
