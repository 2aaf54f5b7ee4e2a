// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../filter_parameters.h"
#include "../filter_report.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../precision.h"
#include "../progress.h"
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
  DenoiseParameters base;
  if (options.text("preset") == "paper")
    base.gpf = GPFParameters::paper();
  DenoiseParameters parameters = readParameters(filterParameters(), options, scale, base);
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
  const bool sampled = result.sample_indices.size() < cloud.finite;
  run.movement = applyPositions(cloud, result, console);
  if (!options.given("no-normals"))
    applyNormals(cloud.file, result, sampled ? std::vector<std::uint32_t>() : result.sample_indices);
  writeCloud(cloud.file, run.output, writeOptions(options));
  run.points = cloud.file.size();
  run.seconds_write = watch.lap();
}

ExitCode
runFilter(const Options& options)
{
  checkOutputs(options);
  Stopwatch total;
  Console console(options);
  FilterRun run;
  LoadedCloud cloud = readInput(options, console, run);
  const CloudScale scale = measureSpacing(cloud, threadCount(options));
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
  OptionSpec preset{"preset", OptionKind::Choice, "", "default", "paper: Algorithm 1 of the paper with its literal values"};
  preset.choices = {"default", "paper"};
  OptionSpec normals{"normals", OptionKind::Choice, "", "auto", "auto: those of the file if it has any, else estimated"};
  normals.choices = {"auto", "file", "estimate"};
  return {preset,
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
                       {"pcl_gpf_tool filter scan.pcd -o even.pcd --samples 50% --repulsion 0.2", "an even half"}}};
  command.options = std::vector<OptionSpec>{outputOption()} + ownOptions() + optionsOf(filterParameters()) +
                    std::vector<OptionSpec>{seedOption(), threadsOption(), formatOption(), overwriteOption(), jsonOption(),
                                            progressOption(), forceOption()};
  command.run = runFilter;
  return command;
}

} // namespace pcl_gpf
