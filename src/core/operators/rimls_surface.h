// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rimls_fit.h"

#include <pcl_gpf/core/operators/rimls.h>
#include <pcl_gpf/core/parallel.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** \brief The samples with their balls, and the loop that fits many positions. */
struct RimlsSurface::Implementation {
  /** Positions whose candidates are looked up together; bounds memory. */
  static constexpr std::size_t kPositionsPerPass = std::size_t{1} << 20;

  RimlsParameters parameters;
  std::unique_ptr<PointIndex> own_index;
  const PointIndex* index = nullptr;
  RimlsSamples samples;
  std::vector<float> radii; ///< h_i, sorted order
  ClusterTree balls;        ///< of radius h_i about the samples
  double largest_radius = 0;
  double spacing = 0;

  /** \brief Everything that follows from parameters, index and samples.normals. */
  void
  prepare();

  /** \brief Calls visit(fit, position, its place in the fit) for every position, on many threads, each once. */
  template <typename Visit>
  void
  fitAll(PointsView positions, const NeighborSearch& search, const Visit& visit) const
  {
    const std::size_t threads = resolveThreads(parameters.number_of_threads);
    for (std::size_t pass = 0; pass < positions.size; pass += kPositionsPerPass) {
      const std::size_t count = std::min(kPositionsPerPass, positions.size - pass);
      SortedVectors<float> queries(count, kFarAway);
      std::copy_n(positions.x + pass, count, queries.x.data());
      std::copy_n(positions.y + pass, count, queries.y.data());
      std::copy_n(positions.z + pass, count, queries.z.data());
      const PointsView view{queries.x.data(), queries.y.data(), queries.z.data(), count};
      const Neighborhoods near = search ? transposeLists(search(index->sorted(), view, largest_radius), count, index->size())
                                        : findNeighborhoods(balls, view, 0.0, threads);
      parallelBlocks(count, RimlsFit::kBatch, threads, [&](std::size_t begin, std::size_t end) {
        RimlsFit fit(parameters, samples);
        fit.run(candidatesOf(near), queries.vectors(), begin, end - begin);
        for (std::size_t i = begin; i < end; ++i)
          visit(fit, pass + i, i - begin);
      });
    }
  }

private:
  void
  chooseRadii(std::size_t threads);
};

} // namespace pcl_gpf
