// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noisy_cloud.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief Command line of the program `quality`. */
struct Options {
  std::vector<std::string> models = {"cube", "block", "sphere", "relief"};
  std::vector<double> noises = {0.25, 0.5, 1};
  std::vector<NoiseKind> kinds = {NoiseKind::Gaussian};
  std::vector<std::size_t> sizes = {33490};
  std::vector<double> outliers = {0};
  std::vector<std::string> methods = {"input", "ours"};
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::size_t references = 200000;
  std::string csv;     ///< file; empty = none
  std::string reuse;   ///< file whose records of other filters are taken instead of running them; empty = none
  std::string svg_dir; ///< folder; empty = none
  std::string cloud_dir; ///< folder for the filtered clouds; empty = none
  bool targets = false;
  bool against_peers = false; ///< judge the means by those of the tuned peers
  bool noise_estimates = false;
  bool help = false;
};

/** \throws std::invalid_argument */
Options
parseOptions(const std::vector<std::string>& arguments);

std::string
usage();

} // namespace pcl_gpf::quality
