// SPDX-License-Identifier: BSD-3-Clause
#include "methods.h"
#include "parameter_changes.h"
#include "peer_variants.h"
#include "rimls_variants.h"
#include "stopwatch.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <stdexcept>

namespace pcl_gpf::quality {

namespace {

MethodResult
identity(const std::vector<Position>& points)
{
  MethodResult result;
  result.points = points;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.seeds.push_back(static_cast<std::uint32_t>(i));
  return result;
}

MethodResult
cleanPoints(const NoisyCloud& cloud, unsigned)
{
  std::vector<Position> points;
  for (const SurfaceSample& s : cloud.clean)
    points.push_back(s.point);
  return identity(points);
}

MethodResult
runDenoise(const NoisyCloud& cloud, const DenoiseParameters& parameters)
{
  std::vector<double> axes[3];
  for (const Position& p : cloud.points)
    for (std::size_t axis = 0; axis < 3; ++axis)
      axes[axis].push_back(p[axis]);
  DenoiseInput input;
  input.x = axes[0].data();
  input.y = axes[1].data();
  input.z = axes[2].data();
  input.size = cloud.points.size();
  MethodResult result;
  const Stopwatch watch;
  const DenoiseResult made = denoise(input, parameters);
  watch.writeTo(result);
  for (std::size_t i = 0; i < made.x.size(); ++i) {
    result.points.push_back({made.x[i], made.y[i], made.z[i]});
    result.normals.push_back({made.normal_x[i], made.normal_y[i], made.normal_z[i]});
  }
  result.seeds = made.sample_indices;
  return result;
}

/** The filter of this project with changes of its parameters, given as "name" or "name=value" with + between. */
Variant
denoiseVariant(const std::string& preset, const std::string& changes)
{
  DenoiseParameters parameters;
  if (preset == "paper")
    parameters.gpf = GPFParameters::paper();
  const ParameterChange change = parseChanges(changes);
  return {"", [parameters, change](const NoisyCloud& cloud, unsigned threads) {
            DenoiseParameters p = parameters;
            change(p, cloud);
            p.number_of_threads = threads;
            return runDenoise(cloud, p);
          }};
}

} // namespace

Method
makeMethod(const std::string& name)
{
  const std::size_t colon = name.find(':');
  const std::string base = name.substr(0, colon), rest = colon == std::string::npos ? "" : name.substr(colon + 1);
  if (base == "ours" || base == "paper")
    return {name, {denoiseVariant(base, rest)}};
  if (name == "input")
    return {name, {{"", [](const NoisyCloud& cloud, unsigned) { return identity(cloud.points); }}}};
  if (name == "clean")
    return {name, {{"", cleanPoints}}};
  if (Method rimls = {name, rimlsVariants(name)}; !rimls.variants.empty())
    return rimls;
  if (Method peer = {name, peerVariants(name)}; !peer.variants.empty())
    return peer;
  throw std::invalid_argument("there is no method \"" + name + "\"; there are\n" + describeMethods());
}

std::string
describeMethods()
{
  return "  input                   the noisy points themselves\n"
         "  clean                   the points before the noise: the floor of cov and ecov\n"
         "  ours                    the chain as denoise() runs it, no parameter given\n"
         "  paper                   Algorithm 1 as printed, GPFParameters::paper()\n"
         "  rimls                   projection onto the RIMLS surface of the noisy points, core/operators/rimls.h;\n"
         "                          with -best behind, the best of a grid of settings\n"
         "  mls, jet                pcl::MovingLeastSquares, CGAL's jet smoothing, and below CGAL's bilateral "
         "smoothing and WLOP,\n"
         "  bilateral, wlop         without tuning; with -best behind, the best of a grid of settings for each cloud\n"
         "  wlop-half               WLOP that keeps half of the points, as papers do, radius 3 % of the diagonal\n"
         "                          (need a build with PCL_GPF_BENCHMARK_PEERS)\n"
         "  ours:CHANGE+CHANGE      the same with parameters changed (also paper:...), CHANGE one of\n" +
         describeChanges();
}

} // namespace pcl_gpf::quality
