// SPDX-License-Identifier: BSD-3-Clause
#include "../apply_result.h"
#include "../console.h"
#include "../field_types.h"
#include "../json_report.h"
#include "../option_groups.h"
#include "../progress.h"
#include "../stopwatch.h"
#include "../upsample_options.h"
#include "commands.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/io/write_cloud.h>
#include <pcl_gpf/pipeline/upsample.h>

#include <nlohmann/json.hpp>

#include <array>
#include <numeric>

namespace pcl_gpf {

namespace {

const std::vector<std::string> kAxes{"x", "y", "z"};
const std::vector<std::string> kNormals{"normal_x", "normal_y", "normal_z"};

bool
takesNormalsOfFile(const Options& options, const CloudFile& file)
{
  if ((options.text("normals") == "file" || options.given("oriented")) && !file.hasNormals())
    throw UnsuitableData("the input has no fields normal_x normal_y normal_z, which --normals file and --oriented need; "
                         "add them with 'pcl_gpf_tool normals'");
  return options.text("normals") != "estimate" && file.hasNormals();
}

/** Writes `values` into the rows from `first` on; fields that are not there yet are added, NaN in other rows. */
void
storeNormals(CloudFile& cloud, std::size_t first, const std::array<const std::vector<float>*, 3>& values)
{
  promoteIntegerFields(cloud, kNormals, FieldType::Float32);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int field = cloud.findField(kNormals[axis]);
    if (field < 0)
      field = cloud.addField(kNormals[axis], FieldType::Float32);
    for (std::size_t k = 0; k < values[axis]->size(); ++k)
      cloud.setValue(first + k, field, static_cast<double>((*values[axis])[k]));
  }
}

/** The output: rows of the input as they are, if they stay, and copies of parents at the new places. */
CloudFile
assemble(const LoadedCloud& cloud, const UpsampleResult& result)
{
  std::vector<std::uint32_t> rows;
  if (result.keeps_input) {
    rows.resize(cloud.file.size());
    std::iota(rows.begin(), rows.end(), std::uint32_t{0});
  }
  const std::size_t first = rows.size();
  rows.insert(rows.end(), result.parents.begin(), result.parents.end());
  CloudFile output = cloud.file.select(rows);
  promoteIntegerFields(output, kAxes, FieldType::Float64);
  widenCoordinates(output, result.x, result.y, result.z);
  for (std::size_t k = 0; k < result.parents.size(); ++k) {
    output.setCoordinate(first + k, 0, result.x[k]);
    output.setCoordinate(first + k, 1, result.y[k]);
    output.setCoordinate(first + k, 2, result.z[k]);
  }
  if (result.keeps_input && result.estimated_normals > 0)
    storeNormals(output, 0, {&result.input_normal_x, &result.input_normal_y, &result.input_normal_z});
  storeNormals(output, first, {&result.normal_x, &result.normal_y, &result.normal_z});
  return output;
}

void
tell(const LoadedCloud& cloud, const UpsampleParameters& parameters, const UpsampleResult& result, Console& console)
{
  if (result.estimated_normals > 0)
    console.say(std::to_string(result.estimated_normals) + " normals were estimated (plane fits, bilateral filter); they are written");
  if (parameters.edge_aware.sign_invariant && parameters.method == UpsamplingMethod::EdgeAware)
    console.say("signs of normals are not used; with --oriented they keep sheets apart that lie closer than two spacings");
  if (cloud.file.isOrganized())
    console.warn("the rows and columns of the organised cloud are given up");
  if (result.non_finite_points > 0 && !result.keeps_input)
    console.warn(std::to_string(result.non_finite_points) + " points without finite coordinates are left out");
  if (result.dropped_points > 0)
    console.warn(std::to_string(result.dropped_points) + " points have fewer than 3 neighbours within the radius and are left out");
  if (!result.target_reached)
    console.warn("the target was not reached: no gap is left within the radius; raise --radius");
}

nlohmann::ordered_json
upsampleReport(const Options& options, const LoadedCloud& cloud, const UpsampleParameters& p, const UpsampleResult& result,
               std::size_t points, double spacing_after)
{
  nlohmann::ordered_json report = newReport("upsample");
  report["input"] = {{"path", options.files()[0]}, {"format", nameOf(cloud.file.format)}, {"points", cloud.file.size()},
                     {"finite", cloud.finite}, {"normals", result.estimated_normals == cloud.finite ? "estimated"
                                                           : result.estimated_normals > 0 ? "completed" : "file"}};
  report["output"] = {{"path", outputPath(options)}, {"points", points}};
  report["points"] = points;
  report["new_points"] = result.parents.size();
  report["estimated_normals"] = result.estimated_normals;
  report["dropped_points"] = result.dropped_points;
  report["spacing"] = {{"before", result.spacing}, {"after", spacing_after}};
  const EdgeAwareUpsamplingParameters& e = p.edge_aware;
  report["parameters"] = {{"method", options.text("method")}, {"target_count", e.target_count}, {"factor", e.factor},
                          {"spacing", e.spacing}, {"radius", result.radius},
                          {"radius_origin", e.radius > 0.0 ? "user" : "estimated"}};
  if (p.method == UpsamplingMethod::EdgeAware)
    report["parameters"].update({{"edge_sensitivity", e.edge_sensitivity}, {"angle", e.angle}, {"sign_invariant", e.sign_invariant}});
  else
    report["parameters"].update({{"mls_order", p.mls_order}, {"seed", p.mls_seed}});
  report["rounds"] = result.rounds;
  report["widest_gap"] = result.widest_gap;
  report["target_reached"] = result.target_reached;
  report["threads"] = resolveThreads(e.number_of_threads);
  return report;
}

ExitCode
runUpsample(const Options& options)
{
  checkOutputs(options);
  checkUpsampleOptions(options);
  Stopwatch total, watch;
  Console console(options);
  const LoadedCloud cloud = loadCloud(options.files()[0], console);
  requireUsable(cloud);
  checkOutputHolds(cloud.file, options);
  const bool file_normals = takesNormalsOfFile(options, cloud.file);
  const UpsampleParameters parameters = readUpsampleParameters(options, cloud);
  const double seconds_read = watch.lap();
  const UpsampleResult result = [&] {
    Progress progress(options);
    const auto update = [&progress](const std::string& stage, double done) { return progress.update(stage, done); };
    return upsample(filterInput(cloud, file_normals).view, parameters, update);
  }();
  tell(cloud, parameters, result, console);
  watch.lap();
  const LoadedCloud output = inspectCloud(assemble(cloud, result));
  writeCloud(output.file, outputPath(options), writeOptions(options));
  const double seconds_write = watch.lap();
  const double spacing_after = measureCloud(output, threadCount(options)).spacing;
  nlohmann::ordered_json report = upsampleReport(options, cloud, parameters, result, output.file.size(), spacing_after);
  const double seconds = total.lap();
  report["seconds"] = {{"read", seconds_read}, {"normals", result.seconds_normals}, {"upsampling", result.seconds_upsampling},
                       {"write", seconds_write}, {"total", seconds}};
  report["peak_bytes"] = peakMemory();
  report["warnings"] = console.warnings();
  console.say("spacing " + shortNumber(result.spacing) + " before, " + shortNumber(spacing_after) + " after, radius " +
              shortNumber(result.radius));
  console.say("wrote " + std::to_string(output.file.size()) + " points, " + std::to_string(result.parents.size()) + " of them new, in " +
              shortNumber(seconds) + " s");
  writeReport(report, options);
  return kExitOk;
}

} // namespace

Command
upsampleCommand()
{
  Command command;
  command.name = "upsample";
  command.summary = "Makes a clean cloud denser: fills the gaps between points, edges first";
  command.synopsis = "IN -o OUT [options]";
  command.examples = {{{"pcl_gpf_tool upsample clean.ply -o dense.ply", "twice as many points"},
                       {"pcl_gpf_tool upsample clean.pcd -o dense.pcd --factor 8 --edge-sensitivity 0", "eight times, evenly"},
                       {"pcl_gpf_tool upsample clean.ply -o dense.ply --spacing 0.5x --json=report.json",
                        "until neighbours are half as far apart, with a report"}}};
  command.options = std::vector<OptionSpec>{outputOption()} + upsampleOptions() +
                    std::vector<OptionSpec>{seedOption(), threadsOption(), formatOption(), overwriteOption(), jsonOption(),
                                            progressOption()};
  command.notes = "With ear, points of the input stay as they are, and come first; each new point has the other fields of the nearest "
                  "one on\nits side of the edge. Noise is not removed: filter first.";
  command.run = runUpsample;
  return command;
}

} // namespace pcl_gpf
