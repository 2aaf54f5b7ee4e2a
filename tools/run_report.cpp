// SPDX-License-Identifier: BSD-3-Clause
#include "run_report.h"

#include "console.h"
#include "filter_report.h"
#include "json_report.h"
#include "run_options.h"

#include <nlohmann/json.hpp>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

Json
filterJson(const ChainRun& run, const DenoiseResult& result)
{
  return {{"spacing", result.scale.spacing},
          {"noise", result.scale.noise},
          {"diagonal", result.scale.diagonal},
          {"iterations", result.iterations.size()},
          {"limited_points", result.limited_points},
          {"parameters", parametersJson(run.filter_parameters)}};
}

Json
orientJson(const ConsolidationParameters& p, const NormalOrientationStatistics& s)
{
  return {{"viewpoint", p.viewpoint ? Json(*p.viewpoint) : Json()},
          {"noise", s.noise},
          {"flipped", s.flipped},
          {"parts", {{"all", s.parts}, {"viewpoint", s.parts_by_viewpoint}, {"outward", s.parts_outward}, {"root", s.parts_by_root}}}};
}

Json
upsampleJson(const ConsolidationResult& result)
{
  const UpsampleResult& u = result.upsampling;
  return {{"points", result.upsampled.size()}, {"spacing", u.spacing},       {"radius", u.radius},
          {"widest_gap", u.widest_gap},        {"dropped", u.dropped_points}, {"target_reached", u.target_reached}};
}

Json
meshJson(const ConsolidationParameters& p, const ConsolidationResult& result)
{
  const MeshResult& m = result.mesh;
  Json json = {{"method", p.meshing.method == MeshMethod::Rimls ? "rimls" : "poisson"},
               {"points", m.points},
               {"points_without_normal", m.points_without_normal},
               {"vertices", m.vertices.size() / 3},
               {"triangles", m.triangles.size() / 3},
               {"open_edges", m.open_edges},
               {"components", m.components}};
  if (p.meshing.method == MeshMethod::Rimls)
    json.update({{"cell", m.rimls.cell_size}, {"spacing", m.rimls.spacing}, {"support_radius", m.rimls.support_radius},
                 {"expected_bytes", m.rimls.expected_memory}});
  return json;
}

Json
secondsJson(const ChainRun& run, const ConsolidationSeconds& s)
{
  return {{"read", run.seconds_read}, {"check", s.check},       {"normals", s.normals}, {"filter", s.filter},         {"orient", s.orient},
          {"upsample", s.upsample},   {"mesh", s.mesh},         {"write", run.seconds_write}, {"total", run.seconds_total}};
}

const ConsolidatedCloud&
lastCloud(const ConsolidationParameters& p, const ConsolidationResult& result)
{
  return p.upsample ? result.upsampled : result.points;
}

} // namespace

Json
runReport(const ChainRun& run, const ConsolidationParameters& p, const ConsolidationResult& result,
          const std::vector<std::string>& warnings)
{
  Json report = newReport("run");
  report["stages"] = Json::array();
  for (const RunStage& stage : runStages())
    if (p.*stage.chosen)
      report["stages"].push_back(stage.name);
  report["input"] = {{"path", run.input}, {"points", run.input_points}, {"finite", run.input_points - result.non_finite_points},
                     {"normals", run.normals}, {"estimated_normals", result.estimated_normals}};
  report["output"] = {{"path", run.output}, {"points", lastCloud(p, result).size()}};
  if (p.mesh)
    report["output"] = {{"path", run.output}, {"vertices", result.mesh.vertices.size() / 3},
                        {"triangles", result.mesh.triangles.size() / 3}, {"colors", run.colors}};
  report["intermediate"] = run.intermediate;
  if (p.filter || p.normals)
    report["filter"] = filterJson(run, result.denoise);
  if (p.orient)
    report["orient"] = orientJson(p, result.orientation);
  if (p.upsample)
    report["upsample"] = upsampleJson(result);
  if (p.mesh)
    report["mesh"] = meshJson(p, result);
  report["threads"] = run.threads;
  report["seconds"] = secondsJson(run, result.seconds);
  report["peak_bytes"] = peakMemory();
  report["warnings"] = warnings;
  return report;
}

std::string
runSummary(const ChainRun& run, const ConsolidationParameters& p, const ConsolidationResult& result)
{
  const auto line = [](const std::string& stage, const std::string& text, double seconds) {
    return stage + ": " + text + "; " + shortNumber(seconds) + " s\n";
  };
  const ConsolidationSeconds& s = result.seconds;
  std::string text;
  if (p.filter)
    text += line("filter", std::to_string(result.points.size()) + " points, spacing " + shortNumber(result.denoise.scale.spacing) +
                               ", noise " + shortNumber(result.denoise.scale.noise), s.normals + s.filter);
  else if (p.normals)
    text += line("normals", std::to_string(result.estimated_normals) + " estimated", s.normals);
  if (p.orient)
    text += line("orient", std::to_string(result.orientation.flipped) + " normals flipped, " + std::to_string(result.orientation.parts) +
                               (result.orientation.parts == 1 ? " part" : " parts"), s.orient);
  if (p.upsample)
    text += line("upsample", std::to_string(result.upsampled.size()) + " points", s.upsample);
  if (p.mesh)
    text += line("mesh", std::to_string(result.mesh.triangles.size() / 3) + " triangles" + (run.colors ? " with colours" : "") + ", " +
                             (result.mesh.open_edges == 0 ? "closed" : std::to_string(result.mesh.open_edges) + " edges at borders"),
                 s.mesh);
  return text + "wrote " + run.output + " in " + shortNumber(run.seconds_total) + " s";
}

} // namespace pcl_gpf
