// SPDX-License-Identifier: BSD-3-Clause
#include "peer_variants.h"
#include "stopwatch.h"

#include <peer_methods.h>

#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <algorithm>
#include <cmath>

namespace pcl_gpf::quality {

namespace {

using namespace benchmark_peers;

/** Settings were found with this many points; numbers of neighbours grow with the cloud so that they cover the same
 * area. */
constexpr double kTunedSize = 33490;

PeerCloud
pack(const NoisyCloud& cloud)
{
  PeerCloud packed;
  for (const Position& p : cloud.points) {
    packed.x.push_back(p[0]);
    packed.y.push_back(p[1]);
    packed.z.push_back(p[2]);
  }
  return packed;
}

std::vector<std::uint32_t>
rows(std::size_t count)
{
  std::vector<std::uint32_t> all(count);
  for (std::size_t i = 0; i < count; ++i)
    all[i] = static_cast<std::uint32_t>(i);
  return all;
}

MethodResult
unpack(const PeerCloud& cloud, std::vector<std::uint32_t> seeds, const Stopwatch& watch)
{
  MethodResult result;
  watch.writeTo(result);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.points.push_back({cloud.x[i], cloud.y[i], cloud.z[i]});
    if (cloud.hasNormals())
      result.normals.push_back({cloud.normal_x[i], cloud.normal_y[i], cloud.normal_z[i]});
  }
  result.seeds = std::move(seeds);
  return result;
}

unsigned
scaled(unsigned neighbors, const NoisyCloud& cloud)
{
  const double size = static_cast<double>(cloud.points.size());
  return static_cast<unsigned>(std::min(std::max(neighbors * size / kTunedSize, 12.0), size));
}

unsigned
resolved(unsigned threads)
{
  return static_cast<unsigned>(resolveThreads(threads));
}

std::string
percent(double share)
{
  return std::to_string(100 * share).substr(0, 4) + " %";
}

Variant
mls(double radius_in_diagonals)
{
  return {"r " + percent(radius_in_diagonals), [=](const NoisyCloud& cloud, unsigned threads) {
            const PeerCloud packed = pack(cloud);
            const Stopwatch watch;
            const PclMlsResult made =
                pclMovingLeastSquares(packed, radius_in_diagonals * cloud.model.surface->diagonal(), resolved(threads));
            return unpack(made.cloud, made.sources, watch);
          }};
}

/** PCL has no default radius; five spacings hold the 75 neighbours of a usual choice. */
Variant
mlsDefault()
{
  return {"r 5 spacings", [](const NoisyCloud& cloud, unsigned threads) {
            return mls(5 * cloud.spacing / cloud.model.surface->diagonal()).run(cloud, threads);
          }};
}

Variant
jet(unsigned neighbors, unsigned passes, bool scale)
{
  return {"k " + std::to_string(neighbors) + " passes " + std::to_string(passes),
          [=](const NoisyCloud& cloud, unsigned threads) {
            PeerCloud packed = pack(cloud);
            const Stopwatch watch;
            cgalJetSmooth(packed, scale ? scaled(neighbors, cloud) : neighbors, passes, resolved(threads));
            return unpack(packed, rows(packed.size()), watch);
          }};
}

Variant
wlop(double radius_in_diagonals, unsigned iterations, double retain_percent)
{
  const std::string radius = radius_in_diagonals > 0 ? "r " + percent(radius_in_diagonals) : "r auto";
  return {radius + " it " + std::to_string(iterations) + " keep " + percent(retain_percent / 100),
          [=](const NoisyCloud& cloud, unsigned threads) {
            const PeerCloud packed = pack(cloud);
            CgalWlopParameters parameters;
            parameters.radius = radius_in_diagonals * cloud.model.surface->diagonal();
            parameters.iterations = iterations;
            parameters.retain_percent = retain_percent;
            const Stopwatch watch;
            return unpack(cgalWlop(packed, parameters, resolved(threads)), {}, watch);
          }};
}

/** Normals of plane fits, filtered bilaterally by this project's filter; lengths in diagonals. */
struct PeerNormals {
  unsigned neighbors;
  double bilateral_radius;
  double angle;
};

/** Gives every normal the sign of the truth, so that no fault of orientation counts against a peer. */
void
orientByTruth(PeerCloud& packed, const NoisyCloud& cloud)
{
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const Position n = {packed.normal_x[i], packed.normal_y[i], packed.normal_z[i]};
    if (dot(n, cloud.clean[i].normal) >= 0)
      continue;
    packed.normal_x[i] = -n[0];
    packed.normal_y[i] = -n[1];
    packed.normal_z[i] = -n[2];
  }
}

void
addFilteredNormals(PeerCloud& packed, const PeerNormals& wanted, const NoisyCloud& cloud, unsigned threads)
{
  estimateNormalsPcl(packed, scaled(wanted.neighbors, cloud), resolved(threads));
  const std::vector<float> x(packed.normal_x.begin(), packed.normal_x.end()),
      y(packed.normal_y.begin(), packed.normal_y.end()), z(packed.normal_z.begin(), packed.normal_z.end());
  DenoiseParameters parameters;
  parameters.bilateral.radius = wanted.bilateral_radius * cloud.model.surface->diagonal();
  parameters.bilateral.angle = wanted.angle;
  parameters.number_of_threads = threads;
  const DenoiseResult filtered = denoiseNormals(
      {packed.x.data(), packed.y.data(), packed.z.data(), packed.size(), x.data(), y.data(), z.data()}, parameters);
  packed.normal_x.assign(filtered.normal_x.begin(), filtered.normal_x.end());
  packed.normal_y.assign(filtered.normal_y.begin(), filtered.normal_y.end());
  packed.normal_z.assign(filtered.normal_z.begin(), filtered.normal_z.end());
  orientByTruth(packed, cloud);
}

Variant
bilateral(PeerNormals normals, CgalBilateralParameters parameters)
{
  return {"k " + std::to_string(parameters.neighbors) + " angle " +
              std::to_string(static_cast<int>(parameters.sharpness_angle)) + " passes " +
              std::to_string(parameters.passes),
          [=](const NoisyCloud& cloud, unsigned threads) {
            PeerCloud packed = pack(cloud);
            CgalBilateralParameters used = parameters;
            used.neighbors = scaled(parameters.neighbors, cloud);
            const Stopwatch watch;
            addFilteredNormals(packed, normals, cloud, threads);
            cgalBilateralSmooth(packed, used, resolved(threads));
            return unpack(packed, rows(packed.size()), watch);
          }};
}

/** What CGAL's manual shows: normals of 24 neighbours, oriented by a spanning tree, one pass; its own angle. */
Variant
bilateralDefault()
{
  return {"k 120 angle 30 passes 1", [](const NoisyCloud& cloud, unsigned threads) {
            PeerCloud packed = pack(cloud);
            const Stopwatch watch;
            cgalPcaNormals(packed, 24, resolved(threads));
            cgalMstOrientNormals(packed, 18);
            cgalBilateralSmooth(packed, {120, 30, 1}, resolved(threads));
            return unpack(packed, rows(packed.size()), watch);
          }};
}

} // namespace

std::vector<Variant>
peerVariants(const std::string& name)
{
  if (name == "mls")
    return {mlsDefault()};
  if (name == "mls-best")
    return {mls(0.015), mls(0.025), mls(0.04), mls(0.06), mls(0.1)};
  if (name == "jet")
    return {jet(24, 1, false)};
  if (name == "jet-best")
    return {jet(48, 2, true), jet(100, 2, true), jet(150, 2, true), jet(300, 1, true)};
  if (name == "bilateral")
    return {bilateralDefault()};
  if (name == "bilateral-best")
    return {bilateral({20, 0.02, 15}, {30, 25, 2}), bilateral({30, 0.03, 15}, {60, 25, 2}),
            bilateral({60, 0.05, 20}, {100, 25, 3}), bilateral({120, 0.07, 25}, {200, 25, 3}),
            bilateral({300, 0.12, 35}, {300, 40, 3})};
  if (name == "wlop")
    return {wlop(0, 35, 5)};
  if (name == "wlop-half")
    return {wlop(0.03, 25, 50)};
  if (name == "wlop-best")
    return {wlop(0.03, 25, 50), wlop(0.05, 20, 50), wlop(0.08, 15, 50)};
  return {};
}

} // namespace pcl_gpf::quality
