// SPDX-License-Identifier: BSD-3-Clause
#include "finest_scale.h"

#include "scale_parameters.h"
#include "two_scales.h"

#include <pcl_gpf/core/operators/thin_parts.h>

#include <algorithm>

namespace pcl_gpf {

namespace {

/** Noise in spacings up to which a ball of some ten points tells a surface from its noise. */
constexpr double kFinestUpTo = 0.5;
/** Least share of the points at which a third filter, whose normals are those of the whole cloud, is worth its time. */
constexpr double kFewestPlaces = 0.025;

/** The result at some rows only. */
FilteredCloud
rowsOf(const FilteredCloud& cloud, const std::vector<std::uint32_t>& rows)
{
  FilteredCloud some;
  some.displacements = elementsOf(cloud.displacements.view(), rows);
  some.normals = elementsOf(cloud.normals.view(), rows);
  for (const std::uint32_t k : rows)
    some.isolated.push_back(cloud.isolated[k]);
  return some;
}

/** Rows of `all` that hold `some`; both ascending. */
std::vector<std::uint32_t>
rowsAmong(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some)
{
  std::vector<std::uint32_t> rows;
  for (std::size_t k = 0; k < all.size() && rows.size() < some.size(); ++k)
    if (all[k] == some[rows.size()])
      rows.push_back(static_cast<std::uint32_t>(k));
  return rows;
}

} // namespace

void
keepThinParts(const DenoiseParameters& parameters, const CloudScale& measured, const CloudScale& scale, const Packed& packed,
              const FilterPlaces& filter, FilteredCloud& cloud, DenoiseResult& result)
{
  if (!parameters.thin_parts || !(scale.noise > 0.0 && scale.noise <= kFinestUpTo * scale.spacing))
    return;
  if (scale.noise < biasOfFewPoints(scale.spacing, static_cast<double>(packed.rows.size())))
    return; // shape, not noise, is what such a cloud's heights are
  const PointsView points = packed.index->sorted();
  const ThinPartsParameters thin = {measured.noise, measured.spacing, parameters.number_of_threads};
  const ThinParts found = findThinParts(thin, *packed.index, movedPoints(points, {}, cloud.displacements), cloud.normals);
  if (static_cast<double>(found.places.size()) < kFewestPlaces * static_cast<double>(points.size))
    return;
  const FilteredCloud finest = filter(parametersAt(FilterScale::Finest, parameters, scale, packed.frame, result), found.places);
  const FilteredCloud before = rowsOf(cloud, found.places);
  replaceAt(found.places, finest, cloud);
  const std::vector<std::uint32_t> kept =
      confirmThinParts(thin, *packed.index, found, movedPoints(points, {}, cloud.displacements), cloud.normals, cloud.fine);
  replaceAt(found.places, before, cloud);
  replaceAt(kept, rowsOf(finest, rowsAmong(found.places, kept)), cloud);
  for (const std::uint32_t k : kept)
    cloud.fine[k] = 1;
  result.finest_points = kept.size();
}

} // namespace pcl_gpf
