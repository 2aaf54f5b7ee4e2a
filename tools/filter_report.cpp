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
iterationsJson(const DenoiseResult& result)
{
  Json list = Json::array();
  for (const IterationStats& stats : result.iterations)
    list.push_back({{"sigma", std::sqrt(stats.variance) * result.scale.diagonal},
                    {"variance", stats.variance},
                    {"next_variance", stats.next_variance},
                    {"movement", stats.mean_movement},
                    {"max_movement", stats.max_movement},
                    {"posterior_sum", stats.posterior_sum},
                    {"isolated", stats.isolated_points},
                    {"seconds", stats.seconds}});
  return list;
}

std::size_t
countIsolated(const DenoiseResult& result)
{
  return static_cast<std::size_t>(std::count(result.isolated.begin(), result.isolated.end(), std::uint8_t{1}));
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
  report["isolated"] = countIsolated(result);
  report["estimated_normals"] = result.estimated_normals;
  report["scale"] = {{"spacing", result.scale.spacing}, {"noise", result.scale.noise},
                     {"diagonal", result.scale.diagonal}, {"h0", result.scale.h0}};
  report["parameters"] = parametersJson(run.parameters);
  report["iterations"] = iterationsJson(result);
  report["movement"] = {{"mean", run.movement.mean}, {"rms", run.movement.rms}, {"p95", run.movement.p95},
                        {"max", run.movement.max}};
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
    if (parameter.origin == "default")
      defaults += (defaults.empty() ? "" : ", ") + item;
    else
      text += "  " + item + " (" + parameter.origin + (parameter.reason.empty() ? "" : ": " + parameter.reason) + ")\n";
  }
  return "parameters\n" + text + "  defaults: " + defaults;
}

std::string
summaryText(const FilterRun& run, const DenoiseResult& result)
{
  const std::size_t isolated = countIsolated(result);
  std::string text = "spacing " + shortNumber(result.scale.spacing) + ", noise " + shortNumber(result.scale.noise) +
                     ", diagonal " + shortNumber(result.scale.diagonal) + ", normals " + run.normals + "\n";
  text += std::to_string(result.iterations.size()) + " iterations; moved: rms " + shortNumber(run.movement.rms) + ", p95 " +
          shortNumber(run.movement.p95) + ", max " + shortNumber(run.movement.max) + "\n";
  if (isolated > 0)
    text += std::to_string(isolated) + " points have no neighbour in reach and stay where they are\n";
  return text + "wrote " + std::to_string(run.points) + " points in " + shortNumber(run.seconds_total) + " s";
}

} // namespace pcl_gpf
