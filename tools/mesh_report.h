// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/pipeline/mesh.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What a run of the mesher has to tell beside its result. */
struct MeshRun {
  std::string input, output;
  std::string normals; ///< "file" or "estimated"
  std::size_t input_points = 0;
  bool colors = false;
  unsigned threads = 0;
  double seconds_read = 0.0, seconds_normals = 0.0, seconds_write = 0.0, seconds_total = 0.0;
};

/** \brief The report of --json. */
nlohmann::ordered_json
meshReport(const MeshRun& run, const MeshParameters& parameters, const MeshResult& result, const std::vector<std::string>& warnings);

/** \brief What happened, in a few lines for the terminal. */
std::string
meshSummary(const MeshRun& run, const MeshResult& result);

} // namespace pcl_gpf
