// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/search_adapter.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/filters/operator_filter.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <chrono>
#include <numeric>

namespace pcl_gpf {

/** \brief Fewer points than this determine no surface that could be filtered. */
constexpr std::size_t kFewestPoints = 4;

template <typename PointT>
OperatorFilter<PointT>::OperatorFilter(const std::string& name, bool extract_removed_indices)
: pcl::Filter<PointT>(extract_removed_indices)
{
  this->filter_name_ = name;
}

template <typename PointT>
OperatorFilter<PointT>::~OperatorFilter() = default;

template <typename PointT> void
OperatorFilter<PointT>::setSearchMethod(const SearchPtr& search)
{
  search_ = search;
}

template <typename PointT> typename OperatorFilter<PointT>::SearchPtr
OperatorFilter<PointT>::getSearchMethod() const
{
  return search_;
}

template <typename PointT> void
OperatorFilter<PointT>::setNumberOfThreads(unsigned int nr_threads)
{
  threads_ = nr_threads;
}

template <typename PointT> unsigned int
OperatorFilter<PointT>::getNumberOfThreads() const
{
  return threads_;
}

template <typename PointT> void
OperatorFilter<PointT>::setProgressCallback(const ProgressCallback& callback)
{
  progress_ = callback;
}

template <typename PointT> const ProgressCallback&
OperatorFilter<PointT>::getProgressCallback() const
{
  return progress_;
}

template <typename PointT> const pcl::Indices&
OperatorFilter<PointT>::getSampleIndices() const
{
  return sample_indices_;
}

template <typename PointT> void
OperatorFilter<PointT>::applyFilter(PointCloud& output)
{
  const auto start = std::chrono::steady_clock::now();
  output.clear(); // never assigned: header and pose are already set
  this->removed_indices_ = pcl::make_shared<pcl::Indices>(); // the old list may be in a caller's hands
  sample_indices_.clear();
  FilterStatistics& statistics = clearStatistics();
  try {
    checkParameters();
    filterPoints(output, statistics);
  }
  catch (const Cancelled&) {
    output.clear();
    statistics.cancelled = true;
    PCL_WARN("[pcl_gpf::%s::applyFilter] Cancelled by the progress callback; the output is empty.\n",
             this->getClassName().c_str());
  }
  catch (...) {
    output.clear();
    rethrowAsPclException(this->getClassName());
  }
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename PointT> void
OperatorFilter<PointT>::filterPoints(PointCloud& output, FilterStatistics& statistics)
{
  const PackedCloud packed = pack(*this->input_, *this->indices_);
  statistics.points = packed.size();
  statistics.points_without_normal = packed.points_without_normal;
  statistics.non_finite_points = packed.non_finite_points;
  if (packed.size() == 0 && packed.points_without_normal > 0)
    throw InvalidParameter("no point has a usable normal; fill the normals before, "
                           "for example with pcl_gpf::estimateNormals() or pcl::NormalEstimationOMP");

  FilteredPoints filtered = seedPoints(packed);
  const bool degenerate = packed.size() < kFewestPoints || packed.all_identical;
  warnAbout(packed, degenerate);
  if (!degenerate) {
    // As many ascending rows as V has are all of them.
    const std::vector<std::uint32_t>& rows = filtered.rows;
    const bool every_row = rows.size() == packed.size() && std::is_sorted(rows.begin(), rows.end());
    const std::size_t threads = resolveThreads(threads_);
    runOperator({packed, rows, every_row, adaptSearch<PointT>(search_, packed.frame, threads)},
                filtered.displacements.view(),
                filtered.normals.view());
  }
  if (keepsOrganisation() && filtered.kept.size() == this->input_->size())
    output.resize(this->input_->width, this->input_->height);
  else
    output.resize(filtered.kept.size());
  unpack(*this->input_, packed, filtered, output);
  reportSeeds(packed, filtered.kept);
}

template <typename PointT> void
OperatorFilter<PointT>::warnAbout(const PackedCloud& packed, bool degenerate) const
{
  const char* name = this->getClassName().c_str();
  if (packed.size() == 0)
    PCL_WARN("[pcl_gpf::%s::applyFilter] None of the %zu points is finite; nothing to filter.\n",
             name,
             packed.chosen.size());
  else if (degenerate)
    PCL_WARN("[pcl_gpf::%s::applyFilter] %zu points%s span no surface; they are copied.\n",
             name,
             packed.size(),
             packed.all_identical ? " at one place" : "");
  if (packed.points_without_normal > 0)
    PCL_WARN("[pcl_gpf::%s::applyFilter] %zu of %zu points have no usable normal and are not filtered.\n",
             name,
             packed.points_without_normal,
             packed.chosen.size());
}

template <typename PointT> std::vector<std::uint32_t>
OperatorFilter<PointT>::keptPoints(const PackedCloud& packed) const
{
  std::vector<std::uint32_t> kept(packed.chosen.size());
  std::iota(kept.begin(), kept.end(), 0u);
  return kept;
}

template <typename PointT> bool
OperatorFilter<PointT>::keepsOrganisation() const
{
  const PointCloud& input = *this->input_;
  return this->fake_indices_ && std::size_t{input.width} * input.height == input.size();
}

template <typename PointT> FilteredPoints
OperatorFilter<PointT>::seedPoints(const PackedCloud& packed) const
{
  std::vector<std::uint32_t> row_of(packed.chosen.size());
  std::uint32_t rows = 0;
  for (std::size_t i = 0; i < row_of.size(); ++i)
    row_of[i] = packed.states[i] == PointState::Usable ? rows++ : rows;

  FilteredPoints filtered;
  filtered.kept = keptPoints(packed);
  for (const std::uint32_t position : filtered.kept)
    if (packed.states[position] == PointState::Usable)
      filtered.rows.push_back(row_of[position]);
  filtered.displacements = SoaBuffer(filtered.rows.size());
  filtered.normals = SoaBuffer(filtered.rows.size());
  for (std::size_t i = 0; i < filtered.rows.size(); ++i) {
    filtered.normals.x[i] = packed.normals.x[filtered.rows[i]];
    filtered.normals.y[i] = packed.normals.y[filtered.rows[i]];
    filtered.normals.z[i] = packed.normals.z[filtered.rows[i]];
  }
  return filtered;
}

template <typename PointT> void
OperatorFilter<PointT>::reportSeeds(const PackedCloud& packed, const std::vector<std::uint32_t>& kept)
{
  std::vector<bool> removed(packed.chosen.size(), true);
  sample_indices_.reserve(kept.size());
  for (const std::uint32_t position : kept) {
    sample_indices_.push_back(packed.chosen[position]);
    removed[position] = packed.states[position] == PointState::NonFinite;
  }
  if (!this->extract_removed_indices_)
    return;
  for (std::size_t i = 0; i < removed.size(); ++i)
    if (removed[i])
      this->removed_indices_->push_back(packed.chosen[i]);
  std::sort(this->removed_indices_->begin(), this->removed_indices_->end());
}

} // namespace pcl_gpf

#define PCL_INSTANTIATE_OperatorFilter(T) template class PCL_GPF_EXPORT pcl_gpf::OperatorFilter<T>;
