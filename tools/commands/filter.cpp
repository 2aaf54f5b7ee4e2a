// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../filter_parameters.h"
#include "../filter_presets.h"
#include "../filter_report.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../precision.h"
#include "../progress.h"
#include "../result_fields.h"
#include "../stopwatch.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/write_cloud.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl_gpf {

namespace {

bool
takesNormalsOfFile(const Options& options, const CloudFile& file)
{
  const std::string& source = options.text("normals");
  if (source == "file" && !file.hasNormals())
    throw UnsuitableData("--normals file: the input has no fields normal_x normal_y normal_z");
  return source != "estimate" && file.hasNormals();
}

DenoiseParameters
chosenParameters(const Options& options, const LoadedCloud& cloud, const CloudScale& scale)
{
  DenoiseParameters parameters = readParameters(filterParameters(), options, scale, presetNamed(options.text("preset")));
  parameters.flags = neededFlags(options);
  if (options.given("samples")) {
    const Share share = options.share("samples");
    parameters.gpf.sample_ratio =
        share.count > 0 ? std::min(1.0, static_cast<double>(share.count) / static_cast<double>(cloud.finite)) : share.ratio;
  }
  parameters.gpf.seed = options.count("seed");
  parameters.number_of_threads = threadCount(options);
  return parameters;
}

std::vector<EffectiveParameter>
allEffective(const Options& options, const DenoiseParameters& used, const DenoiseResult& result)
{
  std::vector<EffectiveParameter> list = effectiveParameters(filterParameters(), options, used, result.parameters);
  const auto origin = [&options](const char* name, bool preset) {
    return std::string(options.given(name) ? "user" : preset ? "preset" : "default");
  };
  for (EffectiveParameter& parameter : list)
    if (parameter.name == "initial-variance" && used.gpf.initial_variance == 0.0 && !result.iterations.empty()) {
      parameter.value = result.iterations.front().variance;
      parameter.origin = "estimated";
      parameter.reason = "(h / 2)^2, squared box diagonals";
    }
  for (const ParameterOrigin& estimate : result.parameters)
    for (const FilterParameter& parameter : filterParameters())
      if (estimate.name == "fine." + parameter.field)
        list.push_back({"fine-" + parameter.option.name, estimate.value, estimate.origin, estimate.reason});
      else if (estimate.name == "finest." + parameter.field)
        list.push_back({"finest-" + parameter.option.name, estimate.value, estimate.origin, estimate.reason});
  for (EffectiveParameter& parameter : list)
    if (parameter.name == "two-scales" && used.two_scales && result.fine.empty())
      parameter = {parameter.name, std::string("off"), parameter.origin, "a radius, repulsion, gap filling, samples or the paper's recursion is asked for"};
  list.push_back({"samples", used.gpf.sample_ratio, origin("samples", used.gpf.sample_ratio != 1.0), "share of the points"});
  list.push_back({"seed", used.gpf.seed, origin("seed", false), ""});
  return list;
}

/** Reads, and refuses whatever can be refused before the work. */
LoadedCloud
readInput(const Options& options, Console& console, FilterRun& run)
{
  Stopwatch watch;
  run.input = options.files()[0];
  run.output = outputPath(options);
  LoadedCloud cloud = loadCloud(run.input, console);
  requireUsable(cloud);
  checkOutputHolds(cloud.file, options);
  checkResultFields(cloud.file, resultFields(options));
  run.input_points = cloud.file.size();
  run.input_finite = cloud.finite;
  run.input_format = nameOf(cloud.file.format);
  run.normals = takesNormalsOfFile(options, cloud.file) ? "file" : "estimated";
  run.seconds_read = watch.lap();
  return cloud;
}

DenoiseResult
runChain(const Options& options, const LoadedCloud& cloud, const DenoiseParameters& parameters, bool file_normals)
{
  Progress progress(options);
  const auto update = [&progress](const std::string& stage, double done) { return progress.update(stage, done); };
  return denoise(filterInput(cloud, file_normals).view, parameters, update);
}

void
writeOutput(const Options& options, LoadedCloud& cloud, const DenoiseResult& result, Console& console, FilterRun& run)
{
  Stopwatch watch;
  run.movement = applyPositions(cloud, result, console);
  const std::vector<std::uint32_t> rows = rowsOf(cloud, result);
  if (!options.given("no-normals"))
    applyNormals(cloud.file, result, rows);
  run.fields = resultFields(options);
  applyResultFields(cloud.file, result, rows, run.movement.of_points, run.fields, console);
  run.outliers = options.text("outliers");
  run.outlier_points = countOutliers(result);
  if (outlierHandling(options) == OutlierHandling::Drop && run.outlier_points > 0) {
    if (cloud.file.isOrganized())
      console.say("the cloud is organised no more, because outliers are dropped");
    if (run.outlier_points == rows.size())
      throw UnsuitableData("all " + std::to_string(rows.size()) + " points look like outliers, nothing would be left; --outliers flag keeps them");
    dropOutliers(cloud.file, result, rows);
    run.dropped = run.outlier_points;
  }
  writeCloud(cloud.file, run.output, writeOptions(options));
  run.points = cloud.file.size();
  run.seconds_write = watch.lap();
}

ExitCode
runFilter(const Options& options)
{
  checkOutputs(options);
  resultFields(options); // refuses wrong names before anything is read
  Stopwatch total;
  Console console(options);
  FilterRun run;
  LoadedCloud cloud = readInput(options, console, run);
  const CloudScale scale = measureCloud(cloud, threadCount(options));
  refuseQuantized(cloud, scale, options.given("force"), console);
  const DenoiseParameters parameters = chosenParameters(options, cloud, scale);
  run.threads = static_cast<unsigned>(resolveThreads(parameters.number_of_threads));
  const DenoiseResult result = runChain(options, cloud, parameters, run.normals == "file");
  run.parameters = allEffective(options, parameters, result);
  console.say(parametersText(run.parameters));
  writeOutput(options, cloud, result, console, run);
  run.seconds_total = total.lap();
  console.say(summaryText(run, result));
  writeReport(filterReport(run, result, console.warnings()), options);
  return kExitOk;
}

std::vector<OptionSpec>
ownOptions()
{
  OptionSpec normals{"normals", OptionKind::Choice, "", "auto", "auto: those of the file if it has any, else estimated"};
  normals.choices = {"auto", "file", "estimate"};
  return {presetOption(),
          {"samples", OptionKind::Share, "N|P%", "100%", "filter and write only a random part of the points, as the paper does"},
          normals,
          {"no-normals", OptionKind::Flag, "", "", "do not write the filtered normals; normals of the input stay as they are"}};
}

} // namespace

Command
filterCommand()
{
  Command command;
  command.name = "filter";
  command.summary = "Removes noise and keeps edges; every point, its order and its other fields stay";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {{{"pcl_gpf_tool filter scan.pcd -o clean.pcd", "everything estimated"},
                       {"pcl_gpf_tool filter scan.ply -o clean.ply --radius 8x --json=report.json", "smoother, with a report"},
                       {"pcl_gpf_tool filter scan.pcd -o part.pcd --preset prismatic --outliers drop --fields movement,edge",
                        "a machined part"}}};
  command.options = std::vector<OptionSpec>{outputOption()} + ownOptions() + resultFieldOptions() + optionsOf(filterParameters()) +
                    std::vector<OptionSpec>{seedOption(), threadsOption(), formatOption(), overwriteOption(), jsonOption(),
                                            progressOption(), forceOption()};
  command.run = runFilter;
  return command;
}

} // namespace pcl_gpf
