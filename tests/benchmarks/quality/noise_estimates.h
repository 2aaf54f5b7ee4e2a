// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

#include <functional>
#include <string>

namespace pcl_gpf::quality {

/** \brief What the noise estimate says of a cloud, against the truth. */
struct NoiseEstimate {
  double truth = 0;    ///< root mean square of the noise along the true normals, model units; points that are no outliers
  double estimate = 0; ///< measureScale(), model units
  double seconds = 0;  ///< processor time of the estimate

  double
  ratio() const
  {
    return estimate / truth;
  }
};

NoiseEstimate
estimateNoiseOf(const NoisyCloud& cloud, unsigned threads);

/** \brief Estimate / truth, one line for each model, size, kind of noise and share of outliers, one column for each level; ratios
 * further than 20 % from 1 are marked. Nothing is filtered. `report` gets each line as soon as it is there. */
void
tabulateNoiseEstimates(const Options& options, const std::function<void(const std::string&)>& report);

} // namespace pcl_gpf::quality
