// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/exceptions.h>
#include <pcl_gpf/common/search_adapter.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/parallel.h>
#include <pcl_gpf/filters/operator_filter.h>
#include <pcl_gpf/filters/seed_points.h>

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

  FilteredPoints filtered = detail::seedPoints(packed, keptPoints(packed));
  const bool degenerate = packed.size() < kFewestPoints || packed.all_identical;
  detail::warnAboutPoints(this->getClassName(), packed, degenerate);
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
  sample_indices_ = detail::seedIndices(packed, filtered.kept);
  if (this->extract_removed_indices_)
    *this->removed_indices_ = detail::removedIndices(packed, filtered.kept);
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

} // namespace pcl_gpf

#define PCL_INSTANTIATE_OperatorFilter(T) template class PCL_GPF_EXPORT pcl_gpf::OperatorFilter<T>;
