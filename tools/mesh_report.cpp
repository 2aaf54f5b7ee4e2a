// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_report.h"

#include "console.h"
#include "json_report.h"

#include <nlohmann/json.hpp>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

Json
parametersJson(const MeshParameters& p)
{
  if (p.method == MeshMethod::Poisson)
    return {{"depth", p.poisson.depth},
            {"point_weight", p.poisson.point_weight},
            {"trim", p.poisson.trim},
            {"smallest", p.poisson.smallest_component}};
  return {{"resolution", p.rimls.resolution},
          {"cell", p.rimls.cell_size},
          {"scale", p.rimls.rimls.scale},
          {"radius", p.rimls.rimls.radius},
          {"sigma_n", p.rimls.rimls.sigma_n},
          {"sigma_r", p.rimls.rimls.sigma_r},
          {"projection", p.rimls.project_vertices},
          {"smallest", p.rimls.smallest_component},
          {"holes", p.rimls.largest_hole},
          {"memory_bytes", p.rimls.memory_limit}};
}

Json
rimlsJson(const RimlsMeshStatistics& s)
{
  return {{"cell", s.cell_size},
          {"spacing", s.spacing},
          {"support_radius", s.support_radius},
          {"expected_bytes", s.expected_memory},
          {"corners", s.cells.corners},
          {"cells", s.cells.cells},
          {"skipped_cells", s.cells.skipped_cells},
          {"removed_components", s.removed_components},
          {"filled_holes", s.filled_holes},
          {"vertex_movement", s.mean_vertex_movement}};
}

} // namespace

Json
meshReport(const MeshRun& run, const MeshParameters& parameters, const MeshResult& result, const std::vector<std::string>& warnings)
{
  const bool rimls = parameters.method == MeshMethod::Rimls;
  Json report = newReport("mesh");
  report["input"] = {{"path", run.input}, {"points", run.input_points}, {"used", result.points}, {"normals", run.normals}};
  report["output"] = {{"path", run.output},
                      {"vertices", result.vertices.size() / 3},
                      {"triangles", result.triangles.size() / 3},
                      {"open_edges", result.open_edges},
                      {"components", result.components},
                      {"colors", run.colors}};
  report["method"] = rimls ? "rimls" : "poisson";
  report["parameters"] = parametersJson(parameters);
  report["orientation"] = {{"oriented", result.oriented || run.normals == "estimated"},
                           {"inconsistent", result.inconsistent_normals},
                           {"flipped", result.orientation.flipped}};
  if (rimls)
    report["rimls"] = rimlsJson(result.rimls);
  report["threads"] = run.threads;
  report["seconds"] = {{"read", run.seconds_read},     {"normals", run.seconds_normals}, {"orient", result.seconds_orient},
                       {"mesh", result.seconds_mesh},  {"write", run.seconds_write},     {"total", run.seconds_total}};
  report["peak_bytes"] = peakMemory();
  report["warnings"] = warnings;
  return report;
}

std::string
meshSummary(const MeshRun& run, const MeshResult& result)
{
  std::string text = "wrote " + std::to_string(result.triangles.size() / 3) + " triangles, " +
                     std::to_string(result.vertices.size() / 3) + " vertices" + (run.colors ? " with colours" : "") + ", " +
                     std::to_string(result.components) + (result.components == 1 ? " part, " : " parts, ") +
                     (result.open_edges == 0 ? "closed" : std::to_string(result.open_edges) + " edges at borders");
  return text + "; " + shortNumber(run.seconds_total) + " s";
}

} // namespace pcl_gpf
