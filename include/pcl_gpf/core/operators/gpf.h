// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/operators/gpf_parameters.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** \brief What the GPF operator works on. gpfInit() copies it, but for `index`, which must outlive the state. */
struct GPFInput {
  PointsView points;                  ///< V: N finite positions in the normalised frame (LocalFrame)
  PointsView remainders;              ///< optional (null pointers: 0): what rounding `points` to float cut off; used by the paper's
                                      ///< recursion, which runs in double
  NormalsView normals;                ///< b_n: N unit vectors, sign free
  const std::uint32_t* samples = nullptr; ///< seeds of X^0 as indices into V; null = every point, in order
  std::size_t sample_count = 0;       ///< M when `samples` is given
  const PointIndex* index = nullptr;      ///< V sorted already: `points` is not read; normals, remainders, samples and all results
                                          ///< are then in sorted order
  NeighborSearch search;                  ///< replaces the built-in neighbour search when set
};

/** \brief State of the GPF recursion: V, X^k, sigma^2 and the neighbour structures. Movable, not copyable. */
class PCL_GPF_CORE_EXPORT GPFState {
public:
  struct Implementation;

  explicit GPFState(std::unique_ptr<Implementation> implementation);
  GPFState(GPFState&&) noexcept;
  GPFState&
  operator=(GPFState&&) noexcept;
  ~GPFState();

  /** \brief M, the number of projected points. */
  std::size_t
  size() const;
  /** \brief Writes X^k in the order of the samples given to gpfInit(), rounded to float. */
  void
  positions(MutableVectorsView out) const;
  /** \brief Writes X^k - X^0 in the same order: add it to the seed's own coordinates, so that nothing is lost to rounding and a
   * point that was not moved keeps its last bit. */
  void
  displacements(MutableVectorsView out) const;
  /** \brief Writes the normals of X in the same order (their seeds' normals). */
  void
  normals(MutableVectorsView out) const;
  /** \brief For each sample 1 if the last step found no data for it but the input point that seeded it, else 0. */
  std::vector<std::uint8_t>
  isolated() const;

  Implementation&
  implementation() { return *implementation_; }

private:
  std::unique_ptr<Implementation> implementation_;
};

/** \brief Prepares the recursion: sorts the points, evaluates the densities rho_n (after eq. 10).
 *
 * \param[in] parameters `support_radius` in the normalised frame and > 0
 * \throws InvalidParameter, ExcessiveWork
 */
PCL_GPF_CORE_EXPORT GPFState
gpfInit(const GPFParameters& parameters, const GPFInput& input);

/** \brief One iteration of Algorithm 1: E-step (eq. 3), M-step (eq. 10), variance (eq. 11); all of X from all of X^k (Jacobi). */
PCL_GPF_CORE_EXPORT IterationStats
gpfStep(GPFState& state);

/** \brief Iterates until convergence or the maximum. \param[in] progress may be empty
 * \return statistics of every iteration \throws Cancelled */
PCL_GPF_CORE_EXPORT std::vector<IterationStats>
gpfRun(GPFState& state, const ProgressCallback& progress = {});

/** \brief The rounds of gap filling that `parameters.gap_iterations` asks for, after gpfRun(): points that were drawn onto sharp edges
 * spread over the bands that they left empty (movesIntoGaps()), and return to the mean plane of the data of their own face. The
 * normals of these points are those of their new places; all others stay to the last bit. \param[in] progress may be empty
 * \return movements and seconds of every round; the last may be missing when there was nothing left to fill
 * \throws ExcessiveWork, Cancelled */
PCL_GPF_CORE_EXPORT std::vector<IterationStats>
gpfFillGaps(GPFState& state, const ProgressCallback& progress = {});

/** \brief Distance within which other points can influence the result of one step: 2 h (repulsion reaches h, its weight w another h). */
PCL_GPF_CORE_EXPORT double
gpfHaloWidth(const GPFParameters& parameters);

} // namespace pcl_gpf
