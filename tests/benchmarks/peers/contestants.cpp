// SPDX-License-Identifier: BSD-3-Clause
#include "contestants.h"
#include "peer_methods.h"

#include "benchmarks/stopwatch.h"

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace pcl_gpf::benchmark_peers {

namespace {

std::string
format(const char* pattern, ...)
{
  char text[200];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

double
diagonalOf(const PeerCloud& cloud)
{
  BoundingBox box;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    box.add(cloud.x[i], cloud.y[i], cloud.z[i]);
  return box.diagonal();
}

/** \param[in] radius of every ball; 0 = estimated lengths */
std::function<Outcome()>
ourChain(const benchmark_models::ModelCloud& cloud, double radius, unsigned threads)
{
  DenoiseParameters parameters;
  parameters.bilateral.iterations = 5;
  parameters.gpf.maximum_iterations = 10;
  parameters.gpf.convergence_threshold = 0.0; // exactly as many
  parameters.gpf.sample_ratio = 1.0;
  parameters.number_of_threads = threads;
  benchmark_models::setBalls(parameters, radius);
  return [&cloud, parameters] {
    const DenoiseResult result = denoise(cloud.input(cloud.x.size()), parameters);
    return Outcome{result.x.size(),
                   {{"normals", result.seconds_normals}, {"bilateral", result.seconds_bilateral}, {"filter", result.seconds_filter}}};
  };
}

/** What bilateral smoothing needs for its best result at 1 % noise: normals, their orientation, and the passes. */
Outcome
bilateralWithNormals(PeerCloud cloud, unsigned threads)
{
  Outcome outcome;
  outcome.points = cloud.size();
  const auto stage = [&](const char* name, const auto& work) {
    const benchmark_timing::Stopwatch watch;
    work();
    outcome.stages.emplace_back(name, watch.elapsed().wall);
  };
  stage("PCA normals", [&] { cgalPcaNormals(cloud, 60, threads); });
  stage("MST orientation", [&] { cgalMstOrientNormals(cloud, 18); });
  stage("3 passes", [&] { cgalBilateralSmooth(cloud, {100, 25, 3}, threads); });
  return outcome;
}

} // namespace

std::vector<Contestant>
contestants(const PeersOptions& o, const benchmark_models::ModelCloud& model)
{
  const auto threads = static_cast<unsigned>(resolveThreads(o.threads));
  const auto cloud = std::make_shared<PeerCloud>();
  cloud->x = model.x;
  cloud->y = model.y;
  cloud->z = model.z;
  const double diagonal = diagonalOf(*cloud);
  const double radius = benchmark_models::Surroundings(model).radiusOfNeighbors(o.neighbors);
  const auto neighbors = static_cast<unsigned>(std::lround(o.neighbors));
  CgalWlopParameters wlop;
  wlop.radius = o.wlop_radius / 100 * diagonal;
  wlop.iterations = o.wlop_iterations;
  wlop.retain_percent = o.wlop_retain;
  const std::string wlop_radius = o.wlop_radius > 0 ? format("r %.2f %% diag", o.wlop_radius) : std::string("CGAL's default r");

  std::vector<Contestant> all = {
      {kOurs, format("balls r %.2f %% diag (%u points), 5 rounds, 10 iterations", 100 * radius / diagonal, neighbors),
       ourChain(model, radius, threads)},
      {kOursDefault, "estimated lengths, 5 rounds, 10 iterations", ourChain(model, 0.0, threads)},
      {"pcl_mls", format("order 2, r %.2f %% diag (%u points)", 100 * radius / diagonal, neighbors),
       [=] { return Outcome{pclMovingLeastSquares(*cloud, radius, threads).cloud.size(), {}}; }},
      {"pcl_normals", format("k %u", neighbors),
       [=] {
         PeerCloud copy = *cloud;
         estimateNormalsPcl(copy, neighbors, threads);
         return Outcome{copy.size(), {}};
       }},
      {"cgal_wlop", wlop_radius + format(", %u iterations, %g %% kept", o.wlop_iterations, o.wlop_retain),
       [=] { return Outcome{cgalWlop(*cloud, wlop, threads).size(), {}}; }},
      {"cgal_bilateral", "PCA k 60, MST k 18, then 3 passes k 100, angle 25", [=] { return bilateralWithNormals(*cloud, threads); }},
      {"cgal_jet", "k 48, 1 pass",
       [=] {
         PeerCloud copy = *cloud;
         cgalJetSmooth(copy, 48, 1, threads);
         return Outcome{copy.size(), {}};
       }}};
  for (const std::string& name : o.methods)
    if (std::none_of(all.begin(), all.end(), [&](const Contestant& c) { return c.name == name; }))
      throw std::invalid_argument("unknown method \"" + name + "\"");
  const auto unwanted = [&](const Contestant& c) {
    return !o.methods.empty() && c.name != kOurs && c.name != kOursDefault &&
           std::find(o.methods.begin(), o.methods.end(), c.name) == o.methods.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  return all;
}

} // namespace pcl_gpf::benchmark_peers
