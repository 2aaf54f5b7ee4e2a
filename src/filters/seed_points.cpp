// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_gpf/filters/seed_points.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <utility>

namespace pcl_gpf::detail {

FilteredPoints
seedPoints(const PackedCloud& packed, std::vector<std::uint32_t> kept)
{
  std::vector<std::uint32_t> row_of(packed.chosen.size());
  std::uint32_t rows = 0;
  for (std::size_t i = 0; i < row_of.size(); ++i)
    row_of[i] = packed.states[i] == PointState::Usable ? rows++ : rows;

  FilteredPoints filtered;
  filtered.kept = std::move(kept);
  for (const std::uint32_t position : filtered.kept)
    if (packed.states[position] == PointState::Usable)
      filtered.rows.push_back(row_of[position]);
  filtered.displacements = SoaBuffer(filtered.rows.size());
  filtered.normals = elementsOf(packed.normals.view(), filtered.rows);
  return filtered;
}

pcl::Indices
seedIndices(const PackedCloud& packed, const std::vector<std::uint32_t>& kept)
{
  pcl::Indices seeds;
  seeds.reserve(kept.size());
  for (const std::uint32_t position : kept)
    seeds.push_back(packed.chosen[position]);
  return seeds;
}

pcl::Indices
removedIndices(const PackedCloud& packed, const std::vector<std::uint32_t>& kept)
{
  std::vector<bool> removed(packed.chosen.size(), true);
  for (const std::uint32_t position : kept)
    removed[position] = packed.states[position] == PointState::NonFinite;
  pcl::Indices indices;
  for (std::size_t i = 0; i < removed.size(); ++i)
    if (removed[i])
      indices.push_back(packed.chosen[i]);
  std::sort(indices.begin(), indices.end());
  return indices;
}

void
warnAboutPoints(const std::string& filter, const PackedCloud& packed, bool degenerate)
{
  const char* name = filter.c_str();
  if (packed.size() == 0)
    PCL_WARN("[pcl_gpf::%s::applyFilter] None of the %zu points is finite; nothing to filter.\n", name, packed.chosen.size());
  else if (degenerate)
    PCL_WARN("[pcl_gpf::%s::applyFilter] %zu points%s span no surface; they are copied.\n", name, packed.size(),
             packed.all_identical ? " at one place" : "");
  if (packed.points_without_normal > 0)
    PCL_WARN("[pcl_gpf::%s::applyFilter] %zu of %zu points have no usable normal and are not filtered.\n", name,
             packed.points_without_normal, packed.chosen.size());
}

} // namespace pcl_gpf::detail
