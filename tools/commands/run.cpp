// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../consolidated_file.h"
#include "../json_report.h"
#include "../mesh_output.h"
#include "../option_groups.h"
#include "../precision.h"
#include "../progress.h"
#include "../run_config.h"
#include "../run_options.h"
#include "../run_report.h"
#include "../stopwatch.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/atomic_file.h>
#include <pcl_gpf/io/write_cloud.h>
#include <pcl_gpf/io/write_mesh.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace pcl_gpf {

namespace {

/** Everything but --config, as it may also stand in the configuration. */
std::vector<OptionSpec>
configurableOptions()
{
  return std::vector<OptionSpec>{outputOption()} + runOptions() +
         std::vector<OptionSpec>{
             {"keep-intermediate", OptionKind::Text, "PREFIX", "", "also write PREFIX-filtered.ply, and PREFIX-upsampled.ply"},
             seedOption(), threadsOption(), formatOption(), overwriteOption(), jsonOption(), progressOption(), forceOption()};
}

struct Intermediate {
  std::string path;
  const ConsolidatedCloud ConsolidationResult::*cloud;
};

std::vector<Intermediate>
intermediates(const Options& options, const ConsolidationParameters& chosen)
{
  std::vector<Intermediate> list;
  if (!options.given("keep-intermediate"))
    return list;
  const std::string& prefix = options.text("keep-intermediate");
  if (chosen.normals || chosen.filter || chosen.orient)
    list.push_back({prefix + "-filtered.ply", &ConsolidationResult::points});
  if (chosen.upsample)
    list.push_back({prefix + "-upsampled.ply", &ConsolidationResult::upsampled});
  return list;
}

/** Refuses what can be refused before the cloud is read. */
void
checkCommandLine(const Options& options, const ConsolidationParameters& chosen)
{
  checkStageOptions(options, chosen);
  const std::string& output = outputPath(options);
  if (!chosen.mesh)
    checkOutputs(options);
  else {
    if (options.given("format"))
      throw UsageError("--format has no meaning with the stage mesh; a mesh is written as binary PLY");
    if (options.given("json") && options.text("json") == output)
      throw UsageError("the mesh and the report both go to '" + output + "'; give --json=FILE another name");
    checkMeshWritable(output, options.given("overwrite"));
    checkReport(options);
  }
  for (const Intermediate& file : intermediates(options, chosen)) {
    if (file.path == output || (options.given("json") && file.path == options.text("json")))
      throw UsageError("'" + file.path + "' is an intermediate result and the output; give one of them another name");
    checkWritable(file.path, options.given("overwrite"));
  }
}

ConsolidationResult
runChain(const Options& options, const LoadedCloud& cloud, const ConsolidationParameters& parameters)
{
  Progress progress(options, Progress::Of::Run);
  const auto update = [&progress](const std::string& stage, double done) { return progress.update(stage, done); };
  return consolidate(filterInput(cloud, cloud.file.hasNormals()).view, parameters, update);
}

/** Reports what the user would not expect. */
void
tell(const CloudFile& file, const ConsolidationParameters& parameters, const ConsolidationResult& result, Console& console)
{
  if (!file.hasNormals() && parameters.mesh && !parameters.orient)
    console.warn("the estimated normals have no consistent signs; the mesh needs the stage orient" +
                 std::string(result.mesh.oriented ? ", which was done for the mesh alone" : ""));
  if (result.mesh.points_without_normal > 0)
    console.warn(std::to_string(result.mesh.points_without_normal) + " points have no usable normal and are left out of the mesh");
  if (result.non_finite_points > 0)
    console.say(std::to_string(result.non_finite_points) + " points without finite coordinates are left out");
  if (parameters.upsample && !result.upsampling.target_reached)
    console.warn("upsampling did not reach its target: no gap is left within the radius; raise --upsample-radius");
  if (parameters.mesh && result.mesh.triangles.empty())
    throw UnsuitableData("the points make no surface at this resolution and support; raise --mesh-scale or lower --mesh-resolution");
}

void
writeResults(const Options& options, LoadedCloud& cloud, const ConsolidationParameters& parameters, const ConsolidationResult& result,
             ChainRun& run)
{
  Stopwatch watch;
  WriteOptions as_ply;
  as_ply.format = CloudFormat::PlyLittleEndian;
  as_ply.overwrite = options.given("overwrite");
  for (const Intermediate& file : intermediates(options, parameters)) {
    writeCloud(consolidatedFile(cloud.file, result.*file.cloud), file.path, as_ply);
    run.intermediate.push_back(file.path);
  }
  if (parameters.mesh) {
    const MeshWriteOptions how = meshWriteOptions(cloud.file, options.given("overwrite"));
    const MeshFile file = meshFile(result.mesh, std::move(cloud.file));
    run.colors = !file.colors.empty();
    writeMesh(file, run.output, how);
  } else
    writeCloud(consolidatedFile(cloud.file, parameters.upsample ? result.upsampled : result.points), run.output, writeOptions(options));
  run.seconds_write = watch.lap();
}

Options
allOptions(Options options)
{
  if (options.given("config"))
    options.complete(readConfig(options.text("config"), configurableOptions()));
  return options;
}

ExitCode
runRun(const Options& command_line)
{
  const Options options = allOptions(command_line);
  const ConsolidationParameters chosen = chosenStages(options);
  refuseOptionsOfOtherStages(command_line, chosen); // a configuration may serve runs with fewer stages
  checkCommandLine(options, chosen);
  Stopwatch total, watch;
  Console console(options);
  ChainRun run;
  run.input = options.files()[0];
  run.output = outputPath(options);
  LoadedCloud cloud = loadCloud(run.input, console);
  requireUsable(cloud);
  run.input_points = cloud.file.size();
  run.normals = cloud.file.hasNormals() && !chosen.normals ? "file" : "estimated";
  const CloudScale scale = measureCloud(cloud, threadCount(options));
  refuseQuantized(cloud, scale, options.given("force"), console);
  const ConsolidationParameters parameters = readRunParameters(options, cloud, scale);
  run.threads = static_cast<unsigned>(resolveThreads(parameters.number_of_threads));
  run.seconds_read = watch.lap();
  const ConsolidationResult result = runChain(options, cloud, parameters);
  run.filter_parameters =
      effectiveParameters(filterParameters(), stageOptions(options, "filter"), parameters.denoise, result.denoise.parameters);
  tell(cloud.file, parameters, result, console);
  writeResults(options, cloud, parameters, result, run);
  run.seconds_total = total.lap();
  console.say(runSummary(run, parameters, result));
  writeReport(runReport(run, parameters, result, console.warnings()), options);
  return kExitOk;
}

} // namespace

Command
runCommand()
{
  Command command;
  command.name = "run";
  command.summary = "The whole chain in one go: normals, filter, orientation, upsampling, mesh";
  command.synopsis = "IN -o OUT.ply [options]";
  command.examples = {{{"pcl_gpf_tool run scan.ply -o mesh.ply", "filter, orient, mesh"},
                       {"pcl_gpf_tool run scan.pcd -o mesh.ply --stages filter,orient,upsample,mesh --keep-intermediate step",
                        "denser before meshing, with the clouds on the way"},
                       {"pcl_gpf_tool run scan.pcd -o mesh.ply --config run.json --json=report.json",
                        "options from a file, with a report"}}};
  command.options = configurableOptions();
  command.options.insert(command.options.begin() + 2, {"config", OptionKind::Text, "FILE", "",
                                                       "options as JSON, {\"mesh\": {\"resolution\": 300}}; the command line goes first"});
  command.notes = "The options of a stage are those of its own command with its name in front: --mesh-resolution is --resolution of 'mesh'. "
                  "Without the\nstage mesh the output is a cloud.";
  command.run = runRun;
  return command;
}

} // namespace pcl_gpf
