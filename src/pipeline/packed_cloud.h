// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/core/operators/gpf.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/pipeline/denoise.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** Finite rows of the input in the normalised frame, sorted along the curve. */
struct Packed {
  LocalFrame frame;
  std::vector<std::uint32_t> rows;   ///< of the input, in sorted order
  std::unique_ptr<PointIndex> index;
  SoaBuffer remainders;              ///< in sorted order; only for the paper's recursion
  SoaBuffer normals;                 ///< in sorted order
  std::vector<std::uint32_t> missing_normals; ///< sorted places
};

/** What a filter made of the packed points, in sorted order (of samples: as drawn). */
struct FilteredCloud {
  SoaBuffer displacements, normals;
  std::vector<std::uint8_t> isolated;
  std::vector<std::uint8_t> fine; ///< 1 = of the fine scale; empty where there is one scale
  SoaBuffer before_gaps;          ///< displacements before gap filling; empty where there was none
  std::vector<IterationStats> gap_iterations; ///< rounds of gap filling, movements in cloud units
  std::vector<float> outlier;     ///< empty where not wanted
  std::vector<double> sigma;      ///< cloud units; empty where not wanted
  std::vector<std::uint8_t> edge;
};

/** \throws UnsuitableData if nothing is finite or everything coincides */
Packed
packPositions(const DenoiseInput& input, bool with_remainders, unsigned number_of_threads);

/** Takes the unit normals that the input has and notes the rest. */
void
packNormals(const DenoiseInput& input, Packed& packed);

/** The normals by input row, NaN for rows that are not packed. */
void
spreadNormals(const Packed& packed, std::size_t size, std::vector<float>& x, std::vector<float>& y, std::vector<float>& z);

/** Where the filter put the samples; no samples: every point. \param[in] points the sorted points \param[in] displacements of each sample */
SoaBuffer
movedPoints(PointsView points, const std::vector<std::uint32_t>& samples, const SoaBuffer& displacements);

/** X^0 as sorted places, ascending by input row; empty = every point. */
std::vector<std::uint32_t>
drawSamples(const GPFParameters& gpf, const Packed& packed);

/** Results in ascending order of input rows; both clouds are given up, so that the result takes their room. */
void
unpack(const DenoiseInput& input, Packed packed, FilteredCloud cloud, const std::vector<std::uint32_t>& samples, std::size_t threads,
       DenoiseResult& result);

} // namespace pcl_gpf
