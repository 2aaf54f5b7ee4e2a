// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmarks/cloud_options.h"

#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * \brief Command line of the benchmark peers.
 */
namespace pcl_gpf::benchmark_peers {

constexpr const char* kUsage =
    R"(usage: peers [--sizes N,N,...] [--threads N] [--repeat N] [--model block|cube|sphere] [--noise PERCENT] [--neighbors K]
             [--methods NAME,NAME,...] [--time-limit SECONDS] [--wlop-radius PERCENT] [--wlop-iterations N] [--wlop-retain PERCENT]
Runs every method in turn on one cloud in one process, --repeat times, and prints medians and the ratios to them of our whole chain:
plane normals, 5 rounds of the bilateral filter, exactly 10 GPF iterations, all points kept.
  --neighbors K          points in the balls of `ours` and of PCL's MLS, and of PCL's normals (default 60)
  --methods              of ours, ours_default, pcl_mls, pcl_normals, cgal_wlop, cgal_bilateral, cgal_jet (default all; ours always run)
  --time-limit SECONDS   a method that has used as much is not run again on that cloud; 0 = no limit (default)
  --wlop-radius PERCENT  of the box diagonal; 0 = CGAL's default, 8 times the mean spacing (default)
  --wlop-iterations N    default 35, as CGAL's
  --wlop-retain PERCENT  of the points (default 50; CGAL's is 5)
)";

struct PeersOptions : benchmark_options::CloudOptions {
  std::vector<std::string> methods; ///< empty: all
  double time_limit = 0.0;
  double wlop_radius = 0.0;
  unsigned wlop_iterations = 35;
  double wlop_retain = 50.0;

  PeersOptions()
  {
    sizes = {100000};
    neighbors = 60.0;
  }
};

inline void
setValue(PeersOptions& o, const std::string& name, const std::string& value)
{
  using benchmark_options::number;
  constexpr std::size_t kSmallestCloud = 1000;
  if (setCloudValue(o, name, value, kSmallestCloud))
    return;
  if (name == "--methods")
    o.methods = benchmark_options::list(value);
  else if (name == "--time-limit")
    o.time_limit = number<double>(value);
  else if (name == "--wlop-radius")
    o.wlop_radius = number<double>(value);
  else if (name == "--wlop-iterations")
    o.wlop_iterations = number<unsigned>(value);
  else if (name == "--wlop-retain")
    o.wlop_retain = number<double>(value);
  else
    throw std::invalid_argument("unknown option: " + name);
}

inline PeersOptions
parse(int argc, char** argv)
{
  PeersOptions o;
  benchmark_options::forEachOption(
      argc, argv, [](const std::string&) { return false; },
      [&](const std::string& name, const std::string& value) { setValue(o, name, value); });
  return o;
}

} // namespace pcl_gpf::benchmark_peers
