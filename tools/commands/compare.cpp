// SPDX-License-Identifier: BSD-3-Clause
#include "../console.h"
#include "../json_report.h"
#include "../load_cloud.h"
#include "../option_groups.h"
#include "../positions.h"
#include "../reference.h"
#include "commands.h"

#include <pcl_gpf/core/analysis/metrics.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/io/errors.h>
#include <pcl_gpf/io/write_cloud.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

void
checkTargets(const Options& options)
{
  checkReport(options);
  if (!options.given("per-point"))
    return;
  const std::string& target = options.text("per-point");
  if (options.given("json") && options.text("json") == target)
    throw UsageError("the cloud and the report both go to '" + target + "'; give --json=FILE another name");
  if (target == "-" && !options.given("json"))
    throw UsageError("the cloud and the figures both go to standard output; give --per-point or --json a file");
  checkWritable(target, options.given("overwrite"));
}

Reference::Kind
kindOf(const Options& options)
{
  const std::string& name = options.text("to");
  if (options.given("same-order")) {
    if (name == "surface" || options.given("symmetric"))
      throw UsageError("--same-order measures row by row between points; leave --symmetric and --to surface away");
    return Reference::Kind::Points;
  }
  return name == "points" ? Reference::Kind::Points : name == "surface" ? Reference::Kind::Surface : Reference::Kind::Auto;
}

std::vector<double>
measure(const Options& options, const std::vector<Position>& points, const Reference& reference)
{
  if (!options.given("same-order"))
    return reference.distances(points, threadCount(options));
  if (points.size() != reference.size())
    throw UnsuitableData("--same-order needs as many points in both files; there are " + std::to_string(points.size()) +
                         " and " + std::to_string(reference.size()));
  return rowDistances(points, reference.points());
}

/** Mean, rms, p95 and max in cloud units and in percent of the diagonal; percents are null where that is 0. */
Json
figures(const DistanceSummary& summary, double diagonal, bool with_sign)
{
  Json json{{"points", summary.count}, {"left_out", summary.left_out}};
  const auto add = [&](const std::string& name, double value) {
    json[name] = value;
    json[name + "_percent"] = diagonal > 0 ? Json(100 * value / diagonal) : Json();
  };
  add("mean", summary.mean);
  add("rms", summary.rms);
  add("p95", summary.p95);
  add("max", summary.max);
  if (with_sign)
    add("signed_mean", summary.signed_mean);
  return json;
}

std::string
table(const Json& json, const std::string& heading)
{
  std::string text = heading + " (" + json["points"].dump() + " points";
  if (json["left_out"] != 0)
    text += ", " + json["left_out"].dump() + " not finite and left out";
  text += ")\n";
  for (const char* name : {"mean", "rms", "p95", "max", "signed_mean"}) {
    if (!json.contains(name))
      continue;
    const std::string value = shortNumber(json[name].get<double>());
    const Json& percent = json[std::string(name) + "_percent"];
    text += "  " + std::string(name) + std::string(12 - std::string(name).size(), ' ') + value +
            std::string(value.size() < 14 ? 14 - value.size() : 1, ' ') +
            (percent.is_null() ? "-" : shortNumber(percent.get<double>())) + " %\n";
  }
  return text;
}

/** A name for the new field that takes nothing away from the file. */
std::string
freeName(const CloudFile& cloud, const std::string& wanted, Console& console)
{
  if (cloud.findField(wanted) < 0)
    return wanted;
  std::string name = wanted + "_to_reference";
  while (cloud.findField(name) >= 0)
    name += "_";
  console.warn("the cloud has a field '" + wanted + "' already; the distances are in '" + name + "'");
  return name;
}

void
writePerPoint(const Options& options, CloudFile cloud, const std::vector<double>& distances, bool with_sign, Console& console)
{
  const auto addColumn = [&](const std::string& name, bool magnitude) {
    const int field = cloud.addField(freeName(cloud, name, console), FieldType::Float64);
    for (std::size_t i = 0; i < distances.size(); ++i)
      cloud.setValue(i, field, magnitude ? std::abs(distances[i]) : distances[i]);
  };
  addColumn("distance", true);
  if (with_sign)
    addColumn("signed_distance", false);
  WriteOptions write;
  write.overwrite = options.given("overwrite");
  writeCloud(cloud, options.text("per-point"), write);
}

Json
measureBack(const Options& options, const std::vector<Position>& points, const Reference& reference)
{
  const std::vector<Position> samples = reference.samples(options.count("samples"), options.count("seed"));
  const std::vector<double> distances = PointDistance(points).distances(samples, threadCount(options));
  return figures(summarizeDistances(distances), reference.diagonal(), false);
}

std::string
textOf(const Json& report)
{
  const Json& b = report["b"];
  const bool mesh = b["kind"] == "surface";
  std::string text = table(report, std::string("A to B, ") + (report["same_order"] == true ? "row by row"
                                                              : mesh                       ? "nearest point of the surface"
                                                                                           : "nearest point"));
  if (report.contains("back"))
    text += table(report["back"], mesh ? "B to A, from samples of the surface" : "B to A, nearest point") +
            "Hausdorff distance " + shortNumber(report["hausdorff"].get<double>()) + "\n";
  return text + "percent of B's box diagonal, " + shortNumber(b["diagonal"].get<double>()) + "\n";
}

ExitCode
runCompare(const Options& options)
{
  const Reference::Kind kind = kindOf(options);
  checkTargets(options);
  Console console(options);
  const LoadedCloud cloud = loadCloud(options.files()[0], console);
  if (cloud.finite == 0)
    throw UnsuitableData(options.files()[0] + ": no point is finite");
  const Reference reference(options.files()[1], kind, console);
  const std::vector<Position> points = positionsOf(cloud.coordinates);
  const std::vector<double> distances = measure(options, points, reference);
  const DistanceSummary summary = summarizeDistances(distances);
  if (summary.count == 0)
    throw UnsuitableData("no point could be measured");

  Json report = newReport("compare");
  report["a"] = {{"path", options.files()[0]}, {"points", cloud.file.size()}, {"finite", cloud.finite}};
  report["b"] = {{"path", options.files()[1]}, {"kind", reference.isMesh() ? "surface" : "points"},
                 {reference.isMesh() ? "triangles" : "points", reference.size()}, {"diagonal", reference.diagonal()}};
  report["same_order"] = options.given("same-order");
  report.update(figures(summary, reference.diagonal(), reference.isMesh()));
  if (options.given("symmetric")) {
    report["back"] = measureBack(options, points, reference);
    report["hausdorff"] = std::max(summary.max, report["back"]["max"].get<double>());
  }
  if (options.given("per-point"))
    writePerPoint(options, cloud.file, distances, reference.isMesh(), console);
  report["warnings"] = console.warnings();
  writeReport(report, options);
  if (!options.given("json"))
    printToStandardOutput(textOf(report));
  return kExitOk;
}

std::vector<OptionSpec>
compareOptions()
{
  OptionSpec to{"to", OptionKind::Choice, "", "auto",
                "what of B is measured against; auto: the surface of a mesh file with faces, else the points"};
  to.choices = {"auto", "points", "surface"};
  OptionSpec samples{"samples", OptionKind::Count, "N", "200000", "samples of B's surface for --symmetric"};
  samples.least = 1;
  samples.most = 1e8;
  return {{"symmetric", OptionKind::Flag, "", "", "measure also back, from B to A: shows gaps and lost parts"},
          {"same-order", OptionKind::Flag, "", "", "distances row by row: how far each point of a filtered cloud moved"},
          to,
          samples,
          {"per-point", OptionKind::Text, "FILE", "",
           "write A with a field 'distance', and 'signed_distance' for a surface"},
          jsonOption(),
          overwriteOption(),
          seedOption(),
          threadsOption()};
}

} // namespace

Command
compareCommand()
{
  Command command;
  command.name = "compare";
  command.summary = "Distances from the points of A to a cloud or mesh B: mean, rms, 95th percentile, largest";
  command.synopsis = "A B [options]";
  command.examples = {{{"pcl_gpf_tool compare clean.pcd scan.pcd --same-order", "how far did each point move"},
                       {"pcl_gpf_tool compare clean.pcd model.ply --symmetric --json", "error against a mesh, both ways"},
                       {"pcl_gpf_tool compare clean.pcd model.obj --per-point error.ply", "the error of each point as a field"}}};
  command.least_files = 2;
  command.most_files = 2;
  command.options = compareOptions();
  command.notes = "B is a cloud, or a mesh (PLY with faces, OFF, OBJ): then the distance is that to the surface, and signed_mean is\n"
                  "negative where A lies inside. Points that are not finite are left out and counted.";
  command.run = runCompare;
  return command;
}

} // namespace pcl_gpf
