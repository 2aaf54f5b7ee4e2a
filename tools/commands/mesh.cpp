// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../mesh_options.h"
#include "../mesh_output.h"
#include "../mesh_report.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../positions.h"
#include "../progress.h"
#include "../stopwatch.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/write_mesh.h>
#include <pcl_gpf/pipeline/orient.h>

#include <nlohmann/json.hpp>

#include <array>
#include <utility>

namespace pcl_gpf {

namespace {

/** Refuses what can be refused before the cloud is read. */
void
checkCommandLine(const Options& options)
{
  checkMeshOptions(options);
  if (outputPath(options) == "-" && options.text("json") == "-")
    throw UsageError("--output - and --json cannot both write to standard output");
  checkMeshWritable(outputPath(options), options.given("overwrite"));
  checkReport(options);
}

/** Normals of the file, or estimated and oriented ones. */
void
chooseNormals(const Options& options, const LoadedCloud& cloud, MeshParameters& parameters, FilterInput& input, MeshRun& run,
              Console& console)
{
  const bool in_file = hasUsableNormal(cloud.file);
  if (options.text("orientation") == "file" && !in_file)
    throw UnsuitableData("--orientation file: the input has no fields normal_x normal_y normal_z, or nothing but zeros and NaN in them");
  input = filterInput(cloud, in_file);
  run.normals = in_file ? "file" : "estimated";
  if (in_file)
    return;
  Progress progress(options);
  const auto update = [&progress](const std::string& stage, double done) { return progress.update(stage, done); };
  const std::optional<std::array<double, 3>> viewpoint = viewpointOf(cloud.file);
  OrientResult oriented = orientCloud(input.view, parameters.orient, viewpoint ? &*viewpoint : nullptr, update);
  input.normal_x = std::move(oriented.normal_x);
  input.normal_y = std::move(oriented.normal_y);
  input.normal_z = std::move(oriented.normal_z);
  input.view.normal_x = input.normal_x.data();
  input.view.normal_y = input.normal_y.data();
  input.view.normal_z = input.normal_z.data();
  parameters.orientation = MeshOrientation::Keep;
  run.seconds_normals = oriented.seconds_normals + oriented.orientation.seconds;
  progress.clear();
  console.say("the input has no normals: they were estimated, filtered and oriented");
}

MeshResult
runMesh(const Options& options, const LoadedCloud& cloud, const MeshParameters& parameters, const FilterInput& input)
{
  Progress progress(options);
  const auto update = [&progress](const std::string& stage, double done) { return progress.update(stage, done); };
  const std::optional<std::array<double, 3>> viewpoint = viewpointOf(cloud.file);
  return meshCloud(input.view, parameters, viewpoint ? &*viewpoint : nullptr, update);
}

void
writeResult(const Options& options, LoadedCloud& cloud, MeshResult& result, MeshRun& run)
{
  Stopwatch watch;
  const MeshWriteOptions how = meshWriteOptions(cloud.file, options.given("overwrite"));
  const MeshFile file = meshFile(result, std::move(cloud.file));
  run.colors = !file.colors.empty();
  writeMesh(file, run.output, how);
  run.seconds_write = watch.lap();
}

ExitCode
runMeshCommand(const Options& options)
{
  checkCommandLine(options);
  Stopwatch total, watch;
  Console console(options);
  MeshRun run;
  run.input = options.files()[0];
  run.output = outputPath(options);
  LoadedCloud cloud = loadCloud(run.input, console);
  requireUsable(cloud);
  run.input_points = cloud.file.size();
  run.seconds_read = watch.lap();
  MeshParameters parameters = readMeshParameters(options, cloud);
  run.threads = static_cast<unsigned>(resolveThreads(parameters.number_of_threads));
  FilterInput input;
  chooseNormals(options, cloud, parameters, input, run, console);
  MeshResult result = runMesh(options, cloud, parameters, input);
  if (result.oriented && run.normals == "file")
    console.say("normals of the file were oriented: " + shortNumber(100.0 * result.inconsistent_normals) +
                " % contradicted their surface");
  if (result.points_without_normal > 0)
    console.warn(std::to_string(result.points_without_normal) + " points have no usable normal and are left out");
  if (result.triangles.empty())
    throw UnsuitableData("the points make no surface at this resolution and support; raise --scale or lower --resolution");
  writeResult(options, cloud, result, run);
  run.seconds_total = total.lap();
  console.say(meshSummary(run, result));
  writeReport(meshReport(run, parameters, result, console.warnings()), options);
  return kExitOk;
}

} // namespace

Command
meshCommand()
{
  Command command;
  command.name = "mesh";
  command.summary = "Makes a triangle mesh of a cloud: RIMLS keeps sharp edges, Poisson closes gaps";
  command.synopsis = "IN -o OUT.ply [options]";
  command.examples = {{{"pcl_gpf_tool mesh clean.ply -o mesh.ply", "RIMLS, 200 cells along the longest side"},
                       {"pcl_gpf_tool mesh clean.ply -o fine.ply --resolution 500 --scale 8", "finer cells, smoother surface"},
                       {"pcl_gpf_tool mesh clean.ply -o closed.ply --method poisson", "closed where points are missing"}}};
  command.options = std::vector<OptionSpec>{outputOption()} + meshOptions() +
                    std::vector<OptionSpec>{threadsOption(), overwriteOption(), jsonOption(), progressOption()};
  command.notes = "The input should be filtered before. Normals of the file are used, and oriented if they contradict each other; a "
                  "file without normals gets them. Vertices have normals, and the colours of the nearest point on the same side.";
  command.run = runMeshCommand;
  return command;
}

} // namespace pcl_gpf
