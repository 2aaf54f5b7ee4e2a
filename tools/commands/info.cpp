// SPDX-License-Identifier: BSD-3-Clause
#include "../console.h"
#include "../json_report.h"
#include "../load_cloud.h"
#include "../option_groups.h"
#include "../precision.h"
#include "commands.h"

#include <pcl_gpf/io/errors.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

/** Mean in two passes, so that coordinates far from the origin lose nothing; null where nothing is finite. */
Json
meanOf(const LoadedCloud& cloud)
{
  if (cloud.finite == 0)
    return nullptr;
  const CloudCoordinates& points = cloud.coordinates;
  const auto count = static_cast<double>(cloud.finite);
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < cloud.file.size(); ++i) {
    if (!std::isfinite(points.x[i]) || !std::isfinite(points.y[i]) || !std::isfinite(points.z[i]))
      continue;
    sum[0] += (points.x[i] - cloud.box.min[0]) / count;
    sum[1] += (points.y[i] - cloud.box.min[1]) / count;
    sum[2] += (points.z[i] - cloud.box.min[2]) / count;
  }
  return {cloud.box.min[0] + sum[0], cloud.box.min[1] + sum[1], cloud.box.min[2] + sum[2]};
}

/** Points that have the same coordinates as an earlier one. */
std::size_t
countDuplicates(const CloudCoordinates& points)
{
  std::vector<std::array<double, 3>> finite;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    if (std::isfinite(points.x[i]) && std::isfinite(points.y[i]) && std::isfinite(points.z[i]))
      finite.push_back({points.x[i], points.y[i], points.z[i]});
  std::sort(finite.begin(), finite.end());
  std::size_t duplicates = 0;
  for (std::size_t i = 1; i < finite.size(); ++i)
    duplicates += finite[i] == finite[i - 1] ? 1 : 0;
  return duplicates;
}

Json
fieldsOf(const CloudFile& file)
{
  Json fields = Json::array();
  for (const CloudField& field : file.fields)
    fields.push_back({{"name", field.name}, {"type", nameOf(field.type)}, {"count", field.count}});
  return fields;
}

Json
infoReport(const std::string& path, const LoadedCloud& cloud, const Console& console, unsigned threads)
{
  const CloudScale scale = measureCloud(cloud, threads);
  const Precision precision = judgePrecision(cloud, scale.spacing);
  Json report = newReport("info");
  report["path"] = path;
  report["format"] = nameOf(cloud.file.format);
  report["points"] = cloud.file.size();
  report["finite"] = cloud.finite;
  report["duplicates"] = countDuplicates(cloud.coordinates);
  report["width"] = cloud.file.width;
  report["height"] = cloud.file.height;
  report["fields"] = fieldsOf(cloud.file);
  report["min"] = cloud.finite ? Json(cloud.box.min) : Json();
  report["max"] = cloud.finite ? Json(cloud.box.max) : Json();
  report["mean"] = meanOf(cloud);
  report["diagonal"] = scale.diagonal;
  report["spacing"] = scale.spacing;
  report["noise"] = scale.noise;
  report["viewpoint"] = cloud.file.viewpoint;
  report["precision"] = {{"verdict", nameOf(precision.verdict)}, {"float_step", precision.step},
                         {"explanation", describe(precision)}};
  report["warnings"] = console.warnings();
  return report;
}

std::string
vectorText(const Json& vector)
{
  std::string text;
  for (const Json& value : vector)
    text += (text.empty() ? "" : " ") + value.dump();
  return text.empty() ? "none" : text;
}

std::string
infoText(const Json& report)
{
  const auto number = [&report](const char* key) { return shortNumber(report[key].get<double>()); };
  std::string fields;
  for (const Json& field : report["fields"]) {
    const auto count = field["count"].get<std::size_t>();
    fields += "\n  " + printable(field["name"].get<std::string>()) + "  " + field["type"].get<std::string>() +
              (count > 1 ? " x " + std::to_string(count) : "");
  }
  return printable(report["path"].get<std::string>(), 1000) + "\n" +
         "format      " + report["format"].get<std::string>() + "\n" +
         "points      " + report["points"].dump() + " (" + report["width"].dump() + " x " + report["height"].dump() + "), " +
         report["finite"].dump() + " finite, " + report["duplicates"].dump() + " duplicates\n" +
         "min         " + vectorText(report["min"]) + "\n" +
         "max         " + vectorText(report["max"]) + "\n" +
         "mean        " + vectorText(report["mean"]) + "\n" +
         "diagonal    " + number("diagonal") + "\n" +
         "spacing     " + number("spacing") + "\n" +
         "noise       " + number("noise") + " (standard deviation along the normal, estimated)\n" +
         "viewpoint   " + vectorText(report["viewpoint"]) + "\n" +
         "precision   " + report["precision"]["explanation"].get<std::string>() + "\n" +
         "fields" + fields + "\n";
}

ExitCode
runInfo(const Options& options)
{
  checkReport(options);
  Console console(options);
  const std::string& path = options.files()[0];
  const LoadedCloud cloud = loadCloud(path, console);
  const Json report = infoReport(path, cloud, console, threadCount(options));
  writeReport(report, options);
  if (!options.given("json"))
    printToStandardOutput(infoText(report));
  const bool nothing_finite = cloud.file.size() > 0 && cloud.finite == 0;
  return nothing_finite ? kExitUnsuitable : kExitOk;
}

} // namespace

Command
infoCommand()
{
  Command command;
  command.name = "info";
  command.summary = "Tells what is in a file: points, fields, box, spacing, noise, precision of the coordinates";
  command.synopsis = "IN [options]";
  command.examples = {{{"pcl_gpf_tool info scan.pcd", "for people"},
                       {"pcl_gpf_tool info scan.ply --json", "for programs"},
                       {"pcl_gpf_tool convert scan.ply -o - | pcl_gpf_tool info -", "from standard input"}}};
  command.options = {jsonOption(), overwriteOption(), threadsOption()};
  command.notes = "The exit code is 5 when there are points and none of them is finite; the report is given all the same.";
  command.run = runInfo;
  return command;
}

} // namespace pcl_gpf
