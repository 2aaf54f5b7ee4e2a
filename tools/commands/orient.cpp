// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../orient_options.h"
#include "../progress.h"
#include "../stopwatch.h"
#include "commands.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/write_cloud.h>
#include <pcl_gpf/pipeline/orient.h>

#include <nlohmann/json.hpp>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

std::string
summaryText(const NormalOrientationStatistics& s)
{
  return std::to_string(s.flipped) + " normals flipped; " + std::to_string(s.parts) +
         " parts: " + std::to_string(s.parts_by_viewpoint) + " toward the viewpoint, " +
         std::to_string(s.parts_outward) + " closed and outward, " + std::to_string(s.parts_by_root) +
         " with the highest point looking up";
}

Json
orientReport(const Options& options, const CloudFile& file, const NormalOrientationParameters& parameters,
             const Viewpoint& viewpoint, const OrientResult& result)
{
  const NormalOrientationStatistics& s = result.orientation;
  Json report = newReport("orient");
  report["input"] = {
      {"path", options.files()[0]},
      {"points", file.size()},
      {"finite", file.size() - result.non_finite_points},
      {"normals", result.estimated_normals + result.non_finite_points == file.size() ? "estimated" : "file"}};
  report["output"] = {{"path", outputPath(options)}, {"points", file.size()}};
  report["points"] = file.size();
  report["estimated_normals"] = result.estimated_normals;
  report["viewpoint"] = viewpoint ? Json(*viewpoint) : Json();
  report["parameters"] = {{"neighbors", parameters.neighbors}, {"noise", s.noise}, {"gap", parameters.gap}};
  report["flipped"] = s.flipped;
  report["parts"] = {
      {"all", s.parts}, {"viewpoint", s.parts_by_viewpoint}, {"outward", s.parts_outward}, {"root", s.parts_by_root}};
  report["votes"] = {{"all", s.votes}, {"disagreeing", s.disagreeing_votes}};
  report["threads"] = resolveThreads(parameters.number_of_threads);
  return report;
}

void
tellAboutNormals(const OrientResult& result, std::size_t finite, Console& console)
{
  if (result.estimated_normals == finite)
    console.say("the input has no normals: plane fits, then the bilateral normal filter made them");
  else if (result.estimated_normals > 0)
    console.warn(std::to_string(result.estimated_normals) + " points had no usable normal and got that of a plane fit");
}

ExitCode
runOrient(const Options& options)
{
  checkOutputs(options);
  Stopwatch total;
  Console console(options);
  LoadedCloud cloud = loadCloud(options.files()[0], console);
  const Viewpoint viewpoint = chosenViewpoint(options, cloud.file);
  requireUsable(cloud);
  checkOutputHolds(cloud.file, options);
  const NormalOrientationParameters parameters = readOrientationParameters(options, cloud);
  OrientResult result = [&] {
    Progress progress(options);
    const auto update = [&progress](const std::string& name, double done) { return progress.update(name, done); };
    return orientCloud(filterInput(cloud, cloud.file.hasNormals()).view, parameters, viewpoint ? &*viewpoint : nullptr,
                       update);
  }();
  tellAboutNormals(result, cloud.finite, console);
  console.say(summaryText(result.orientation));
  DenoiseResult normals;
  normals.normal_x = std::move(result.normal_x);
  normals.normal_y = std::move(result.normal_y);
  normals.normal_z = std::move(result.normal_z);
  applyNormals(cloud.file, normals, {});
  writeCloud(cloud.file, outputPath(options), writeOptions(options));
  console.say("wrote " + std::to_string(cloud.file.size()) + " points");
  Json report = orientReport(options, cloud.file, parameters, viewpoint, result);
  report["seconds"] = {
      {"normals", result.seconds_normals}, {"orient", result.orientation.seconds}, {"total", total.lap()}};
  report["peak_bytes"] = peakMemory();
  report["warnings"] = console.warnings();
  writeReport(report, options);
  return kExitOk;
}

} // namespace

Command
orientCommand()
{
  Command command;
  command.name = "orient";
  command.summary = "Gives normals consistent signs: toward the viewpoint, or outward where the surface is closed";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {
      {{"pcl_gpf_tool orient clean.ply -o oriented.ply", "closed parts outward"},
       {"pcl_gpf_tool orient kinect.pcd -o oriented.pcd --viewpoint 0,0,0", "the camera is at the origin"},
       {"pcl_gpf_tool orient noisy.ply -o oriented.ply --neighbors 30", "stronger noise"}}};
  command.options =
      std::vector<OptionSpec>{outputOption()} + orientOptions() +
      std::vector<OptionSpec>{threadsOption(), formatOption(), overwriteOption(), jsonOption(), progressOption()};
  command.notes =
      "Points stay as they are; normals of the input keep their directions. A cloud without normals gets them first.";
  command.run = runOrient;
  return command;
}

} // namespace pcl_gpf
