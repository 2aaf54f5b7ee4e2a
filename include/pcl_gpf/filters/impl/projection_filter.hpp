// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/sampling.h>
#include <pcl_gpf/filters/projection_filter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_gpf {

template <typename PointT>
ProjectionFilter<PointT>::ProjectionFilter(const std::string& name, bool extract_removed_indices)
: OperatorFilter<PointT>(name, extract_removed_indices)
{}

template <typename PointT>
ProjectionFilter<PointT>::~ProjectionFilter() = default;

template <typename PointT> void
ProjectionFilter<PointT>::setSampleIndices(const pcl::Indices& indices)
{
  requested_samples_ = indices;
}

template <typename PointT> void
ProjectionFilter<PointT>::setSampleRatio(double ratio)
{
  sample_ratio_ = ratio;
}

template <typename PointT> double
ProjectionFilter<PointT>::getSampleRatio() const
{
  return sample_ratio_;
}

template <typename PointT> void
ProjectionFilter<PointT>::setSeed(std::uint64_t seed)
{
  seed_ = seed;
}

template <typename PointT> std::uint64_t
ProjectionFilter<PointT>::getSeed() const
{
  return seed_;
}

template <typename PointT> std::vector<std::uint32_t>
ProjectionFilter<PointT>::keptPoints(const PackedCloud& packed) const
{
  if (!(sample_ratio_ > 0 && sample_ratio_ <= 1))
    throw InvalidParameter("sample_ratio = " + std::to_string(sample_ratio_) + ": must be in (0, 1]");
  if (!requested_samples_.empty())
    return explicitSamples(packed);
  return sample_ratio_ < 1 ? randomSamples(packed) : everyPoint(packed);
}

template <typename PointT> std::vector<std::uint32_t>
ProjectionFilter<PointT>::everyPoint(const PackedCloud& packed) const
{
  const bool holes = this->keepsOrganisation() && this->input_->isOrganized();
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (holes || packed.states[i] != PointState::NonFinite)
      kept.push_back(static_cast<std::uint32_t>(i));
  return kept;
}

template <typename PointT> std::vector<std::uint32_t>
ProjectionFilter<PointT>::randomSamples(const PackedCloud& packed) const
{
  std::vector<std::uint32_t> usable;
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] == PointState::Usable)
      usable.push_back(static_cast<std::uint32_t>(i));
  const auto share = static_cast<std::size_t>(std::round(sample_ratio_ * static_cast<double>(usable.size())));
  std::vector<std::uint32_t> kept = randomSubset(usable.size(), std::max<std::size_t>(1, share), seed_);
  for (std::uint32_t& sample : kept)
    sample = usable[sample];
  return kept;
}

template <typename PointT> std::vector<std::uint32_t>
ProjectionFilter<PointT>::explicitSamples(const PackedCloud& packed) const
{
  constexpr std::uint32_t kNotUsable = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> position_of(this->input_->size(), kNotUsable);
  for (std::size_t i = 0; i < packed.chosen.size(); ++i)
    if (packed.states[i] == PointState::Usable)
      position_of[static_cast<std::size_t>(packed.chosen[i])] = static_cast<std::uint32_t>(i);

  std::vector<std::uint32_t> kept;
  std::vector<bool> taken(packed.chosen.size(), false);
  for (const pcl::index_t index : requested_samples_) {
    const bool in_range = index >= 0 && static_cast<std::size_t>(index) < position_of.size();
    const std::uint32_t position = in_range ? position_of[static_cast<std::size_t>(index)] : kNotUsable;
    if (position == kNotUsable)
      throw InvalidParameter("sample index " + std::to_string(index) +
                             " is not a point of setIndices() with a finite position and a usable normal");
    if (!taken[position])
      kept.push_back(position);
    taken[position] = true;
  }
  return kept;
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_ProjectionFilter(T) template class PCL_GPF_EXPORT pcl_gpf::ProjectionFilter<T>;
