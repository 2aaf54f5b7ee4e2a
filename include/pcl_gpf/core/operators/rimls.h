// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>
#include <pcl_gpf/core/implicit_function.h>
#include <pcl_gpf/core/iteration.h>
#include <pcl_gpf/core/neighbor_lists.h>
#include <pcl_gpf/core/operators/rimls_parameters.h>
#include <pcl_gpf/core/point_index.h>
#include <pcl_gpf/core/views.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** \brief What became of a projected position. */
enum class RimlsState : std::uint8_t {
  Converged,    ///< |f| fell below the accuracy
  TooManySteps, ///< it did not within the maximum: the position of least |f| is returned
  Outside       ///< outside the domain: left where it was
};

/** \brief What RimlsSurface::project() did. Lengths in the unit of the points. */
struct RimlsProjectionStatistics {
  std::size_t iterations = 0;
  std::size_t converged = 0;
  std::size_t too_many_steps = 0;
  std::size_t outside = 0;
  double mean_movement = 0; ///< over all positions
  double max_movement = 0;
};

/** \brief Implicit surface of points with consistently oriented normals: robust implicit moving least squares
 * (Oeztireli, Guennebaud, Gross, "Feature Preserving Point Set Surfaces based on Non-Linear Kernel Regression",
 * Eurographics 2009).
 *
 * With u = x - p_i, f_i = u.n_i and w_i = (1 - u^2 / h_i^2)^4 for u < h_i, else 0: f = sum w f_i / sum w, first with
 * these weights, then with w_i exp(-|n_i - grad f|^2 / sigma_n^2) exp(-((f_i - f) / (sigma_r h_i))^2), f and grad f
 * those of the fit before, until grad f changes by less than sqrt(1e-3) or the maximum number of fits is reached. grad
 * f takes the robust factors as constant. Sharp edges stay because beyond one the normals differ. On convex parts the
 * surface lies outside the points by about h^2 / (12 R) (it inherits the bias of tangent planes); keep h small against
 * the radius of curvature.
 *
 * The domain is where at least `minimum_samples` samples reach and one is within `domain` r_i; outside there is no
 * value. Memory: about 60 bytes a point. const functions may be called from several threads at once; results do not
 * depend on the number of threads, nor on the instruction set.
 */
class PCL_GPF_CORE_EXPORT RimlsSurface {
public:
  /** \param[in] points N finite positions in the normalised frame, copied
   * \param[in] normals N unit vectors, oriented consistently: one flipped patch cancels f
   * \param[in] parameters lengths in the unit of the points \throws InvalidParameter, ExcessiveWork */
  RimlsSurface(const RimlsParameters& parameters, PointsView points, NormalsView normals);
  /** \brief The same on points that are sorted already, normals in sorted order; `points` must outlive the surface. */
  RimlsSurface(const RimlsParameters& parameters, const PointIndex& points, NormalsView normals);
  RimlsSurface(RimlsSurface&&) noexcept;
  RimlsSurface&
  operator=(RimlsSurface&&) noexcept;
  ~RimlsSurface();

  /** \brief f, grad f and the domain at any positions. Cost grows when consecutive positions are far from each other.
   * \throws ExcessiveWork if the support radius holds too many points */
  void
  evaluate(PointsView positions, const ImplicitValues& values) const;

  /** \brief Moves positions onto the surface: x <- x - f grad f / |grad f|, at most h / 2 a step, until |f| is at most
   * accuracy * spacing.
   *
   * \param[in,out] positions any order
   * \param[out] normals unit gradients at the last evaluation; not written where the state is Outside
   * \param[out] states one a position, or null
   * \param[in] search replaces the built-in neighbour search when set; called with the largest support radius
   * \throws ExcessiveWork, Cancelled */
  RimlsProjectionStatistics
  project(MutableVectorsView positions,
          MutableVectorsView normals,
          RimlsState* states = nullptr,
          const NeighborSearch& search = {},
          const ProgressCallback& progress = {}) const;

  /** \brief Median of r_i / 1.13, the typical distance between neighbouring points; 0 without points. */
  double
  spacing() const;
  /** \brief Support radius h_i of every point, in the order of the points given. */
  std::vector<float>
  supportRadii() const;
  const PointIndex&
  points() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pcl_gpf
