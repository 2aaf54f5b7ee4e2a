// SPDX-License-Identifier: BSD-3-Clause
#include "two_scales.h"

#include <algorithm>

namespace pcl_gpf {

namespace {

void
setDisplacement(PointsView points, const SoaBuffer& positions, std::size_t k, FilteredCloud& cloud)
{
  cloud.displacements.x[k] = positions.x[k] - points.x[k];
  cloud.displacements.y[k] = positions.y[k] - points.y[k];
  cloud.displacements.z[k] = positions.z[k] - points.z[k];
}

} // namespace

bool
filtersTwoScales(const DenoiseParameters& p)
{
  const bool estimated = p.normals.radius == 0.0 && p.bilateral.radius == 0.0 && p.bilateral.neighbors == 0 && p.gpf.support_radius == 0.0;
  return p.two_scales && estimated && !runsInDouble(p.gpf) && p.gpf.sample_ratio == 1.0 && p.gpf.repulsion_weight == 0.0 &&
         p.gpf.gap_iterations == 0 && p.gpf.maximum_iterations > 0;
}

std::vector<std::uint32_t>
lostDetail(const ScaleSelectionParameters& selection, const Packed& packed, const FilteredCloud& coarse)
{
  const std::vector<std::uint8_t> fine =
      selectFineScale(selection, *packed.index, movedPoints(packed.index->sorted(), {}, coarse.displacements), coarse.normals);
  std::vector<std::uint32_t> places;
  places.reserve(static_cast<std::size_t>(std::count(fine.begin(), fine.end(), 1)));
  for (std::size_t k = 0; k < fine.size(); ++k)
    if (fine[k] != 0)
      places.push_back(static_cast<std::uint32_t>(k));
  return places;
}

void
steer(const SteeredFitParameters& parameters, const Packed& packed, const std::vector<std::uint32_t>& places, FilteredCloud& cloud,
      const ProgressCallback& progress)
{
  const PointsView points = packed.index->sorted();
  SoaBuffer positions = movedPoints(points, {}, cloud.displacements);
  fitSteeredPlanes(parameters, points, places, positions.view(), cloud.normals.view(), progress);
  for (const std::uint32_t k : places)
    setDisplacement(points, positions, k, cloud);
}

void
fitSmoothParts(const QuadricFitParameters& parameters, const Packed& packed, FilteredCloud& cloud, const ProgressCallback& progress)
{
  if (parameters.levels == 0)
    return;
  const PointsView points = packed.index->sorted();
  SoaBuffer positions = movedPoints(points, {}, cloud.displacements);
  fitQuadrics(parameters, points, positions.view(), cloud.normals.view(), progress);
  for (std::size_t k = 0; k < points.size; ++k)
    setDisplacement(points, positions, k, cloud);
}

void
replaceAt(const std::vector<std::uint32_t>& places, const FilteredCloud& fine, FilteredCloud& whole)
{
  const auto copy = [](const SoaBuffer& from, std::size_t s, SoaBuffer& to, std::size_t k) {
    to.x[k] = from.x[s];
    to.y[k] = from.y[s];
    to.z[k] = from.z[s];
  };
  for (std::size_t s = 0; s < places.size(); ++s) {
    copy(fine.displacements, s, whole.displacements, places[s]);
    copy(fine.normals, s, whole.normals, places[s]);
    whole.isolated[places[s]] = fine.isolated[s];
  }
}

} // namespace pcl_gpf
