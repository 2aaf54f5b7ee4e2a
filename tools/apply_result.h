// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"

#include <pcl_gpf/pipeline/denoise.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_gpf {

class Console;

/** \brief How far points moved, measured on the coordinates that are written; cloud units. */
struct Movement {
  double mean = 0.0;
  double rms = 0.0;
  double p95 = 0.0; ///< 95 of 100 points moved no more than this
  double max = 0.0;
  std::size_t limited = 0;       ///< points that could not go further
  std::vector<double> of_points; ///< of each point of the result
};

/** \brief Puts filtered coordinates into the input's rows: order, organisation, other fields and rows without finite coordinates
 * stay. Where the result has fewer points, only their rows stay, in order. Integer coordinates become double. No written point is further from its input than result.max_move. */
Movement
applyPositions(LoadedCloud& cloud, const DenoiseResult& result, Console& console);

/** \brief Writes the normals of the rows `rows` into the fields normal_x normal_y normal_z, added as float where they are missing;
 * all other rows of added fields are NaN, of existing ones unchanged.
 * \param[in] rows of `cloud`, one per normal; empty = all */
void
applyNormals(CloudFile& cloud, const DenoiseResult& result, const std::vector<std::uint32_t>& rows);

/** \brief Row of `cloud` that holds each point of the result, after applyPositions(). */
std::vector<std::uint32_t>
rowsOf(const LoadedCloud& cloud, const DenoiseResult& result);

/** \brief View of a cloud for denoise(); the normals are copied into `normals` when `with_normals`. */
struct FilterInput {
  DenoiseInput view;
  std::vector<float> normal_x, normal_y, normal_z;
};
FilterInput
filterInput(const LoadedCloud& cloud, bool with_normals);

} // namespace pcl_gpf
