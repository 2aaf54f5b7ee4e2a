// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../filter_parameters.h"
#include "../filter_report.h"
#include "../option_groups.h"
#include "../progress.h"
#include "commands.h"

#include <pcl_gpf/io/write_cloud.h>

namespace pcl_gpf {

namespace {

/** The parameters of the first two steps of the filter, two of them under the shorter names that suffice here. */
const std::vector<FilterParameter>&
normalTable()
{
  static const std::vector<FilterParameter> table = [] {
    std::vector<FilterParameter> selected = selectParameters({"normals.radius", "bilateral.iterations", "bilateral.radius",
                                                              "bilateral.neighbors", "bilateral.angle",
                                                              "bilateral.sign_invariant"});
    for (FilterParameter& parameter : selected) {
      if (parameter.field == "normals.radius")
        parameter.option.name = "radius";
      if (parameter.field == "bilateral.neighbors")
        parameter.option.name = "k";
    }
    return selected;
  }();
  return table;
}

ExitCode
runNormals(const Options& options)
{
  checkOutputs(options);
  Console console(options);
  LoadedCloud cloud = loadCloud(options.files()[0], console);
  requireUsable(cloud);
  checkOutputHolds(cloud.file, options);
  const CloudScale scale =
      needsScale(normalTable(), options) ? measureCloud(cloud, threadCount(options)) : CloudScale();
  DenoiseParameters parameters = readParameters(normalTable(), options, scale, DenoiseParameters());
  parameters.number_of_threads = threadCount(options);
  const bool file_normals = options.given("keep") && cloud.file.hasNormals();
  const DenoiseResult result = [&] {
    Progress progress(options);
    const auto update = [&progress](const std::string& name, double done) { return progress.update(name, done); };
    return denoiseNormals(filterInput(cloud, file_normals).view, parameters, update);
  }();
  std::vector<EffectiveParameter> used = effectiveParameters(normalTable(), options, parameters, result.parameters);
  console.say(parametersText(used));
  applyNormals(cloud.file, result, {});
  writeCloud(cloud.file, outputPath(options), writeOptions(options));
  console.say("wrote " + std::to_string(cloud.file.size()) + " points");
  return kExitOk;
}

} // namespace

Command
normalsCommand()
{
  Command command;
  command.name = "normals";
  command.summary = "Adds normals that stay sharp at edges: plane fits, then the bilateral normal filter";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {{{"pcl_gpf_tool normals scan.pcd -o with_normals.pcd", "everything estimated"},
                       {"pcl_gpf_tool normals scan.pcd -o fits.pcd --bilateral-iterations 0", "plain plane fits"},
                       {"pcl_gpf_tool normals scan.ply -o sharper.ply --keep --bilateral-iterations 10",
                        "filter the normals of the file"}}};
  command.options = std::vector<OptionSpec>{outputOption()} + optionsOf(normalTable()) +
                    std::vector<OptionSpec>{{"keep", OptionKind::Flag, "", "", "start from the normals of the file, if it has any"},
                                            threadsOption(), formatOption(), overwriteOption(), progressOption()};
  command.notes = "Points stay as they are; normals of the input are replaced. Their signs are repeatable, not oriented.";
  command.run = runNormals;
  return command;
}

} // namespace pcl_gpf
