// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noisy_cloud.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_gpf::quality {

/** \brief What a method made of a cloud. */
struct MethodResult {
  std::vector<Position> points;
  std::vector<Position> normals; ///< one per point, of any sign, or empty
  std::vector<std::uint32_t>
      seeds; ///< row of the input that each point came from, or empty when the method does not tell
  double seconds = 0, processor_seconds = 0;
};

/** \brief One way to run a method. */
struct Variant {
  std::string setting; ///< for the table; empty when there is only one
  std::function<MethodResult(const NoisyCloud& cloud, unsigned threads)> run;
};

/** \brief A method; of several variants the one with the least mean error counts. */
struct Method {
  std::string name;
  std::vector<Variant> variants;
};

/** \brief A method by its name, for example "ours", "paper" or "ours:point-to-plane+iterations=3".
 * \throws std::invalid_argument on unknown names */
Method
makeMethod(const std::string& name);

/** \brief One line for each method and change, for the usage text. */
std::string
describeMethods();

} // namespace pcl_gpf::quality
