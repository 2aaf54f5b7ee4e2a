// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/pipeline/consolidate.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_gpf {

/** One stage of a run as its callback names it, and the work that it is expected to be, in any one unit. */
struct ExpectedStage {
  std::string name;
  double cost;
};

/** The stages of consolidate() in their order; the costs are microseconds of one thread, measured on scans. */
std::vector<ExpectedStage>
expectedStages(const ConsolidationParameters& parameters, std::size_t points, double longest_side);

/** Turns the progress of single stages into that of the whole: it never falls, whatever is left out, comes unexpected or starts
 * again, and what is left of the whole is shared out among the stages that are left. */
class OverallProgress {
public:
  OverallProgress(std::vector<ExpectedStage> stages, StageProgress callback);

  /** \return false: cancelled */
  bool
  report(const std::string& stage, double fraction);

  /** Reports 1. \return false: cancelled */
  bool
  finish();

private:
  void
  begin(const std::string& stage);

  std::vector<ExpectedStage> stages_; ///< the one that runs, then those to come
  StageProgress callback_;
  double unexpected_cost_ = 1.0;
  double begin_ = 0.0; ///< of the whole, where the stage that runs began
  double value_ = 0.0;
};

} // namespace pcl_gpf
