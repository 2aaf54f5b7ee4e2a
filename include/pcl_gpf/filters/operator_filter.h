// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/abi_check.h>
#include <pcl_gpf/common/export.h>
#include <pcl_gpf/common/pack.h>
#include <pcl_gpf/common/unpack.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/neighbor_lists.h>

#include <pcl/filters/filter.h>
#include <pcl/search/search.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief What every filter of this library reports after filter(). */
struct FilterStatistics {
  std::size_t points = 0;                ///< N: points with finite position and a normal, the data set V
  std::size_t points_without_normal = 0; ///< finite position, normal NaN or zero: not data; copied, or removed by sampling
  std::size_t non_finite_points = 0;     ///< not data; removed, or a hole of an organised cloud
  double seconds = 0;                    ///< of the whole call
  bool cancelled = false;                ///< the progress callback returned false; the output is empty
};

/** \brief An operator of the core as a pcl::Filter: the base of all filters here, which holds PCL's contract once.
 *
 * - The data set V is exactly the usable points of setIndices(), all points by default: indices choose data and queries
 *   alike. An index given twice counts once. Output points are in the order of the indices.
 * - An output point is its seed point as a whole, with position and normal replaced. Header and sensor pose are the
 *   input's.
 * - getRemovedIndices(): those of setIndices() that seeded no output point and those that are not finite, ascending;
 *   needs the constructor's argument true. getSampleIndices(): the seed of every output point.
 * - An organised cloud stays organised when there are no indices and every point is kept; its holes stay, as NaN.
 * - Fewer than four usable points, and points that all coincide, are copied with a warning. Nothing finite: a warning
 *   and an empty output (an organised cloud: all holes).
 * - The object can be used again after success, cancellation and exceptions, after which the output is empty; an
 *   in-place call that throws leaves the cloud as it was. Without an input cloud PCL prints an error and leaves the
 *   output alone.
 * \throws pcl::BadArgumentException if a parameter or an index is out of range or no point has a usable normal,
 * pcl::ComputeFailedException if the work would be excessive
 * Thread safety: one object, one thread at a time. The result does not depend on the number of threads.
 */
template <typename PointT>
class OperatorFilter : public pcl::Filter<PointT> {
  static_assert(pcl::traits::has_xyz_v<PointT> && pcl::traits::has_normal_v<PointT>,
                "pcl_gpf filters need a point type with xyz and normal fields, for example pcl::PointNormal; "
                "copy the cloud into one with pcl::copyPointCloud() and fill the normals with pcl_gpf::estimateNormals()");

public:
  using Ptr = pcl::shared_ptr<OperatorFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const OperatorFilter<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;
  using SearchPtr = typename pcl::search::Search<PointT>::Ptr;

  ~OperatorFilter() override;

  /** \brief Neighbour search; null = the built-in tree, which is faster. Default null. The result is the same.
   * \note The search is given temporary clouds and keeps the last of them. pcl::search::OrganizedNeighbor cannot serve.
   */
  void
  setSearchMethod(const SearchPtr& search);
  SearchPtr
  getSearchMethod() const;

  /** \brief Threads; 0 = all that the process may use. Default 0. */
  void
  setNumberOfThreads(unsigned int nr_threads = 0);
  unsigned int
  getNumberOfThreads() const;

  /** \brief Called with the fraction done, from the calling thread; if it returns false, filter() prints a warning and
   * leaves an empty output, and getStatistics().cancelled is true. Default none. */
  void
  setProgressCallback(const ProgressCallback& callback);
  const ProgressCallback&
  getProgressCallback() const;

  /** \brief After filter(): for each output point the input index of the point that seeded it. */
  const pcl::Indices&
  getSampleIndices() const;

protected:
  /** \brief What an operator works on. */
  struct OperatorInput {
    const PackedCloud& cloud;               ///< V, normalised frame
    const std::vector<std::uint32_t>& rows; ///< M rows of V that seed the output
    bool every_row;                         ///< rows are 0 .. N - 1
    NeighborSearch search;                  ///< empty = built in
  };

  OperatorFilter(const std::string& name, bool extract_removed_indices);

  void
  applyFilter(PointCloud& output) final;

  /** \brief Empties the derived class's statistics. \return their common part, for this class to fill */
  virtual FilterStatistics&
  clearStatistics() = 0;

  /** \brief Checks every parameter. \throws InvalidParameter */
  virtual void
  checkParameters() const = 0;

  /** \brief Which points of packed.chosen make the output, in output order; all by default. \throws InvalidParameter */
  virtual std::vector<std::uint32_t>
  keptPoints(const PackedCloud& packed) const;

  /** \brief Runs the operator.
   * \param[in,out] displacements M in the normalised frame, all 0 so far \param[in,out] normals M, so far those of the
   * seeds
   * \throws InvalidParameter, UnsuitableData, ExcessiveWork, Cancelled */
  virtual void
  runOperator(const OperatorInput& input, MutableVectorsView displacements, MutableVectorsView normals) = 0;

  /** \brief Whether the output can have the input's rows and columns. */
  bool
  keepsOrganisation() const;

private:
  void
  filterPoints(PointCloud& output, FilterStatistics& statistics);

  SearchPtr search_;
  unsigned int threads_ = 0;
  ProgressCallback progress_;
  pcl::Indices sample_indices_;
};

} // namespace pcl_gpf

#ifdef PCL_NO_PRECOMPILE
#include <pcl_gpf/filters/impl/operator_filter.hpp>
#endif
