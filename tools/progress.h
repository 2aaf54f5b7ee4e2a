// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace pcl_gpf {

class Options;

/** \brief Shows how far a run is on standard error: a bar with the time left on a terminal, lines elsewhere. */
class Progress {
public:
  explicit Progress(const Options& options);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress&
  operator=(const Progress&) = delete;

  /** \brief To be called with the stage and its fraction done in [0, 1]. \return true: the run goes on */
  bool
  update(const std::string& stage, double fraction);

  /** \brief Removes the bar, so that a message can follow. */
  void
  clear();

private:
  using Clock = std::chrono::steady_clock;
  enum class Mode { None, Bar, Lines, RareLines };

  void
  showBar(double fraction, const std::string& left) const;

  Mode mode_;
  std::string stage_;
  Clock::time_point stage_begin_;
  Clock::time_point last_shown_;
  int last_tenth_ = 0;
  bool bar_visible_ = false;
};

} // namespace pcl_gpf
