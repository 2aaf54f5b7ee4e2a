// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace pcl_gpf {

class Options;

/** \brief Shows how far a run is on standard error: a bar with the time left on a terminal, lines elsewhere. */
class Progress {
public:
  /** \brief What the fractions are of. */
  enum class Of { Stage, Run };

  explicit Progress(const Options& options, Of of = Of::Stage);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress&
  operator=(const Progress&) = delete;

  /** \brief To be called with the stage and the fraction done, of it or of the run, in [0, 1]. \return true: the run goes on */
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
  Of of_;
  std::string stage_;
  Clock::time_point begin_; ///< of what the fractions are of
  Clock::time_point last_shown_;
  int last_tenth_ = 0;
  bool bar_visible_ = false;
};

} // namespace pcl_gpf
