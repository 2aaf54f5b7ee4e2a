// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_flags.h"

#include "move_limit.h"
#include "scale_parameters.h"

#include <pcl_gpf/core/operators/edge_points.h>
#include <pcl_gpf/core/operators/local_noise.h>
#include <pcl_gpf/core/operators/outlier_probability.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_gpf {

namespace {

/** Noise that judges outliers: as estimated, which is that of the quietest parts of a cloud, or that of most of the moves. */
double
noiseOfMoves(double noise, std::vector<float> moves)
{
  constexpr double kQuartileOfNormal = 1.1503; // three of four moves are shorter, in standard deviations
  constexpr double kMostUneven = 2.0;
  if (moves.empty())
    return noise;
  const auto quartile = moves.begin() + static_cast<std::ptrdiff_t>(moves.size() * 3 / 4);
  std::nth_element(moves.begin(), quartile, moves.end());
  return std::clamp(static_cast<double>(*quartile) / kQuartileOfNormal, noise, kMostUneven * noise);
}

/** Not where the noise is unknown, nor where the filter moves points of the surface by more than outliers are told by. */
bool
tellsOutliers(const DenoiseParameters& p, const CloudScale& scale, std::size_t points)
{
  const bool few = p.gpf.support_radius == 0.0 && biasOfFewPoints(scale.spacing, static_cast<double>(points)) >
                                                      std::max(scale.noise, 0.5 * scale.spacing);
  return points >= kFewestForNoise && !few;
}

} // namespace

void
findFlags(const DenoiseParameters& p, const CloudScale& scale, double data_radius, const Packed& packed,
          const std::vector<std::uint32_t>& samples, FilteredCloud& cloud)
{
  if (!(scale.spacing > 0.0) || !(p.flags.outliers || p.flags.sigma || p.flags.edges))
    return;
  const SoaBuffer places = movedPoints(packed.index->sorted(), samples, cloud.displacements);
  const SoaBuffer& judged = cloud.before_gaps.size() > 0 ? cloud.before_gaps : cloud.displacements;
  std::vector<float> moves(judged.size());
  for (std::size_t k = 0; k < moves.size(); ++k)
    moves[k] = static_cast<float>(lengthOf(judged, k));
  if (p.flags.outliers && !tellsOutliers(p, scale, packed.rows.size()))
    cloud.outlier.assign(moves.size(), 0.0f);
  else if (p.flags.outliers)
    cloud.outlier = outlierProbabilities(
        {noiseOfMoves(scale.noise, moves), scale.spacing, data_radius, p.gpf.outlier_weight, p.number_of_threads}, *packed.index,
        places, moves.data());
  if (p.flags.sigma) {
    std::vector<float> weights(cloud.outlier.size());
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] = 1.0f - cloud.outlier[k];
    const std::vector<float> local = localNoise({data_radius, scale.spacing, p.number_of_threads}, places.view(), cloud.normals.view(), moves.data(),
                             weights.empty() ? nullptr : weights.data());
    for (const float sigma : local)
      cloud.sigma.push_back(packed.frame.lengthToWorld(static_cast<double>(sigma)));
  }
  if (p.flags.edges) {
    EdgePointsParameters edges;
    edges.support_radius = 2.0 * data_radius;
    edges.spacing = scale.spacing;
    edges.number_of_threads = p.number_of_threads;
    cloud.edge = edgePoints(edges, places.view(), cloud.normals.view());
  }
}

} // namespace pcl_gpf
