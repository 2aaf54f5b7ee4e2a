// SPDX-License-Identifier: BSD-3-Clause
#include "filter_report.h"

#include "console.h"
#include "json_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

Json
iterationsJson(const std::vector<IterationStats>& iterations, double diagonal)
{
  Json list = Json::array();
  for (const IterationStats& stats : iterations)
    list.push_back({{"sigma", std::sqrt(stats.variance) * diagonal},
                    {"variance", stats.variance},
                    {"next_variance", stats.next_variance},
                    {"movement", stats.mean_movement},
                    {"max_movement", stats.max_movement},
                    {"posterior_sum", stats.posterior_sum},
                    {"isolated", stats.isolated_points},
                    {"seconds", stats.seconds}});
  return list;
}

Json
gapsJson(const std::vector<IterationStats>& rounds)
{
  Json list = Json::array();
  for (const IterationStats& stats : rounds)
    list.push_back({{"movement", stats.mean_movement}, {"max_movement", stats.max_movement}, {"seconds", stats.seconds}});
  return list;
}

std::size_t
countOnes(const std::vector<std::uint8_t>& flags)
{
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
}

} // namespace

Json
parametersJson(const std::vector<EffectiveParameter>& parameters)
{
  Json object = Json::object();
  for (const EffectiveParameter& parameter : parameters) {
    Json& entry = object[parameter.name];
    std::visit([&entry](const auto& value) { entry["value"] = value; }, parameter.value);
    entry["origin"] = parameter.origin;
    entry["reason"] = parameter.reason;
  }
  return object;
}

Json
filterReport(const FilterRun& run, const DenoiseResult& result, const std::vector<std::string>& warnings)
{
  Json report = newReport("filter");
  report["input"] = {{"path", run.input}, {"format", run.input_format}, {"points", run.input_points},
                     {"finite", run.input_finite}, {"normals", run.normals}};
  report["output"] = {{"path", run.output}, {"points", run.points}};
  report["points"] = run.points;
  report["isolated"] = countOnes(result.isolated);
  report["estimated_normals"] = result.estimated_normals;
  report["outliers"] = {{"handling", run.outliers}, {"count", run.outlier_points}, {"dropped", run.dropped},
                        {"left_out_of_data", result.repeated}};
  if (!result.edge.empty())
    report["edge_points"] = countOnes(result.edge);
  if (!result.fine.empty())
    report["fine_points"] = countOnes(result.fine);
  if (result.finest_points > 0)
    report["finest_points"] = result.finest_points;
  report["fields"] = run.fields;
  report["scale"] = {{"spacing", result.scale.spacing}, {"noise", result.scale.noise},
                     {"diagonal", result.scale.diagonal}, {"h0", result.scale.h0}};
  report["parameters"] = parametersJson(run.parameters);
  report["iterations"] = iterationsJson(result.iterations, result.scale.diagonal);
  if (!result.fine_iterations.empty())
    report["fine_iterations"] = iterationsJson(result.fine_iterations, result.scale.diagonal);
  if (!result.gap_iterations.empty())
    report["gap_iterations"] = gapsJson(result.gap_iterations);
  report["movement"] = {{"mean", run.movement.mean}, {"rms", run.movement.rms}, {"p95", run.movement.p95},
                        {"max", run.movement.max}, {"limited", std::max(result.limited_points, run.movement.limited)}};
  report["threads"] = run.threads;
  report["seconds"] = {{"read", run.seconds_read},
                       {"normals", result.seconds_normals},
                       {"bilateral", result.seconds_bilateral},
                       {"filter", result.seconds_filter},
                       {"write", run.seconds_write},
                       {"total", run.seconds_total}};
  report["peak_bytes"] = peakMemory();
  report["warnings"] = warnings;
  return report;
}

std::string
parametersText(const std::vector<EffectiveParameter>& parameters)
{
  std::string text, defaults;
  for (const EffectiveParameter& parameter : parameters) {
    const std::string item = parameter.name + " " + valueText(parameter.value);
    if (parameter.origin == "default" && parameter.reason.empty())
      defaults += (defaults.empty() ? "" : ", ") + item;
    else
      text += "  " + item + " (" + parameter.origin + (parameter.reason.empty() ? "" : ": " + parameter.reason) + ")\n";
  }
  return "parameters\n" + text + "  defaults: " + defaults;
}

std::string
summaryText(const FilterRun& run, const DenoiseResult& result)
{
  const std::size_t isolated = countOnes(result.isolated);
  std::string text = "spacing " + shortNumber(result.scale.spacing) + ", noise " + shortNumber(result.scale.noise) +
                     ", diagonal " + shortNumber(result.scale.diagonal) + ", normals " + run.normals + "\n";
  text += std::to_string(result.iterations.size()) + " iterations; moved: rms " + shortNumber(run.movement.rms) + ", p95 " +
          shortNumber(run.movement.p95) + ", max " + shortNumber(run.movement.max) + "\n";
  if (!result.gap_iterations.empty())
    text += std::to_string(result.gap_iterations.size()) + " rounds of gap filling; moved first: mean " +
            shortNumber(result.gap_iterations.front().mean_movement) + ", max " +
            shortNumber(result.gap_iterations.front().max_movement) + "\n";
  if (!result.fine.empty())
    text += std::to_string(countOnes(result.fine)) + " points from the fine scale, the others from the coarse one\n";
  if (result.finest_points > 0)
    text += std::to_string(result.finest_points) + " of them from the finest scale: thin parts\n";
  const std::size_t limited = std::max(result.limited_points, run.movement.limited);
  if (limited > 0)
    text += std::to_string(limited) + " moves cut to " + shortNumber(result.max_move) + "\n";
  if (run.outlier_points > 0)
    text += std::to_string(run.outlier_points) + " outliers" +
            (run.outliers == "drop" ? " dropped" : run.outliers == "flag" ? " flagged (field outlier above 0.5)" : " kept") +
            (result.repeated ? ", and left out of the data of the others" : "") + "\n";
  if (!result.edge.empty())
    text += std::to_string(countOnes(result.edge)) + " edge points\n";
  if (isolated > 0)
    text += std::to_string(isolated) + " points have no neighbour in reach and stay where they are\n";
  return text + "wrote " + std::to_string(run.points) + " points in " + shortNumber(run.seconds_total) + " s";
}

} // namespace pcl_gpf
