// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"
#include "options.h"

#include <pcl_gpf/pipeline/consolidate.h>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief One stage of `run`, its switch, and the group of options ("mesh" for --mesh-resolution) that set it. */
struct RunStage {
  std::string name;
  bool ConsolidationParameters::*chosen;
  std::string group; ///< the stages normals and filter share one
};

/** \brief All stages in the order in which they run. */
const std::vector<RunStage>&
runStages();

/** \brief --stages, and the options of the stages' own commands with the group in front. */
std::vector<OptionSpec>
runOptions();

/** \brief The options of a group under the names that they have in their own command. */
Options
stageOptions(const Options& options, const std::string& group);

/** \brief Switches of the stages in --stages. \throws UsageError: a word that is none, or twice */
ConsolidationParameters
chosenStages(const Options& options);

/** \brief Refuses options of stages that are not chosen. \throws UsageError */
void
refuseOptionsOfOtherStages(const Options& options, const ConsolidationParameters& chosen);

/** \brief Refuses what the options of one stage tell against each other. \throws UsageError */
void
checkStageOptions(const Options& options, const ConsolidationParameters& chosen);

/** \brief All parameters, with the lengths of this cloud. \throws UsageError */
ConsolidationParameters
readRunParameters(const Options& options, const LoadedCloud& cloud, const CloudScale& scale);

} // namespace pcl_gpf
