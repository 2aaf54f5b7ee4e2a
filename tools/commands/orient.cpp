// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../option_values.h"
#include "../progress.h"
#include "../stopwatch.h"
#include "commands.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/write_cloud.h>
#include <pcl_gpf/pipeline/orient.h>

#include <nlohmann/json.hpp>

#include <array>
#include <optional>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;
using Viewpoint = std::optional<std::array<double, 3>>;

/** What --viewpoint stands for; a file without a sensor has its viewpoint at the origin, which auto takes for none. */
Viewpoint
chosenViewpoint(const Options& options, const CloudFile& file)
{
  const std::string& text = options.text("viewpoint");
  const std::array<double, 3> sensor{file.viewpoint[0], file.viewpoint[1], file.viewpoint[2]};
  if (text == "none" || (text == "auto" && sensor == std::array<double, 3>{}))
    return std::nullopt;
  if (text == "auto")
    return sensor;
  const std::optional<std::vector<double>> given = parseVector(text);
  if (!given)
    throw UsageError("--viewpoint " + text + ": expected auto, none or three numbers, for example 0,0,1.5");
  return std::array<double, 3>{(*given)[0], (*given)[1], (*given)[2]};
}

NormalOrientationParameters
chosenParameters(const Options& options, const LoadedCloud& cloud)
{
  const Length noise = options.length("noise");
  const bool measured = noise.unit == Length::Unit::Spacing || noise.unit == Length::Unit::Diagonal;
  NormalOrientationParameters parameters;
  parameters.neighbors = static_cast<unsigned>(options.count("neighbors"));
  parameters.noise = noise.resolve(measured ? measureCloud(cloud, threadCount(options)) : CloudScale());
  parameters.gap = options.number("gap");
  parameters.number_of_threads = threadCount(options);
  return parameters;
}

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
  const NormalOrientationParameters parameters = chosenParameters(options, cloud);
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

std::vector<OptionSpec>
ownOptions()
{
  const NormalOrientationParameters defaults;
  OptionSpec neighbors{"neighbors", OptionKind::Count, "N", std::to_string(defaults.neighbors),
                       "nearest neighbours that each point votes with; more for strong noise, fewer for thin sheets"};
  neighbors.least = 3;
  neighbors.most = 100;
  OptionSpec gap{"gap", OptionKind::Number, "X", "6",
                 "spacings across which separate parts still vote; 0 = each for itself"};
  gap.least = 0;
  gap.most = 100;
  return {{"viewpoint", OptionKind::Text, "X,Y,Z", "auto",
           "turn parts toward this point; auto: the viewpoint of the file unless it is 0,0,0; none: closed parts "
           "outward, others up"},
          neighbors,
          {"noise", OptionKind::Length, "LENGTH", "auto",
           "standard deviation along the normals; shorter offsets tell nothing"},
          gap};
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
      std::vector<OptionSpec>{outputOption()} + ownOptions() +
      std::vector<OptionSpec>{threadsOption(), formatOption(), overwriteOption(), jsonOption(), progressOption()};
  command.notes =
      "Points stay as they are; normals of the input keep their directions. A cloud without normals gets them first.";
  command.run = runOrient;
  return command;
}

} // namespace pcl_gpf
