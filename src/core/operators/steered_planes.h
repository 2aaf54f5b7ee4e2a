// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/operators/steered_fit.h>

#include "../sorted_points.h"
#include "normal_tensors.h"
#include "steered_guide.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

/** Where planes are wanted. */
struct SteeredQueries {
  SortedVectors<float> positions, normals;
  std::vector<std::uint32_t> data; ///< the datum of each query, whose tensor steers it; ascending
};

/** What the planes say. */
struct SteeredMoves {
  SortedVectors<float> moves;
  SortedVectors<float> normals; ///< on the side of the query's; 0 where the data span no plane, and the move is 0 as well
};

/** \brief Fits a plane over the ellipsoid of each query and finds its move along that plane's normal to the mean noisy height. */
SteeredMoves
fitPlanes(const SteeredFitParameters& parameters, const SteeredGuide& guide, const NormalTensors& tensors,
          const SteeredQueries& queries, std::size_t threads);

} // namespace pcl_gpf
