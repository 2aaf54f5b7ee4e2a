// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * \brief Filters of PCL and CGAL on plain arrays, for comparison only.
 *
 * This header shows neither library, so a program that includes it compiles quickly. The library behind it holds code of CGAL under
 * the GPL: it is never installed, and nothing that is installed may link it.
 */
namespace pcl_gpf::benchmark_peers {

/** \brief Finite positions in any unit and, unless empty, one normal for each. */
struct PeerCloud {
  std::vector<double> x, y, z;
  std::vector<double> normal_x, normal_y, normal_z;

  std::size_t size() const { return x.size(); }
  bool hasNormals() const { return !x.empty() && normal_x.size() == x.size(); }
};

// All functions: `threads` >= 1 is the largest number of threads used; results do not depend on it. They throw
// std::invalid_argument for a parameter out of its range and for a cloud of fewer points than the method can work on.

/** \brief pcl::NormalEstimationOMP: plane of the `neighbors` nearest (3 .. size), the point itself included; signs face the origin. */
void
estimateNormalsPcl(PeerCloud& cloud, unsigned neighbors, unsigned threads);

/** \brief Result of pclMovingLeastSquares(): ascending by source. */
struct PclMlsResult {
  PeerCloud cloud;                    ///< with normals of arbitrary sign
  std::vector<std::uint32_t> sources; ///< input index of each point; those with fewer than three neighbours are missing
};

/** \brief pcl::MovingLeastSquares, polynomials of order 2, normals computed, one projection (PCL's default method, SIMPLE).
 * \param[in] radius of the neighbourhood, unit of the cloud, > 0 */
PclMlsResult
pclMovingLeastSquares(const PeerCloud& cloud, double radius, unsigned threads);

/** \brief Parameters of CGAL::wlop_simplify_and_regularize_point_set; the defaults are CGAL's own. */
struct CgalWlopParameters {
  double radius = 0.0;          ///< unit of the cloud; 0 = CGAL's choice, 8 times the mean distance of 6 neighbours
  unsigned iterations = 35;     ///< >= 1
  double retain_percent = 5.0;  ///< share of points put out, 0 < percent <= 100
  bool uniform_sampling = false; ///< weigh by the density of the input
};

/** \brief WLOP: size * retain_percent / 100 points in no order, without normals. */
PeerCloud
cgalWlop(const PeerCloud& cloud, const CgalWlopParameters& parameters, unsigned threads);

/** \brief Parameters of CGAL::bilateral_smooth_point_set. */
struct CgalBilateralParameters {
  unsigned neighbors = 100;      ///< 2 .. size
  double sharpness_angle = 25.0; ///< degrees, 0 .. 90; small: sharp edges stay
  unsigned passes = 3;           ///< calls in a row
};

/** \brief Moves points and normals, in order; needs consistently oriented normals. */
void
cgalBilateralSmooth(PeerCloud& cloud, const CgalBilateralParameters& parameters, unsigned threads);

/** \brief CGAL::jet_smooth_point_set with its degrees of 2; moves the points, in order. \param[in] neighbors 6 .. size
 * \param[in] passes calls in a row */
void
cgalJetSmooth(PeerCloud& cloud, unsigned neighbors, unsigned passes, unsigned threads);

/** \brief CGAL::pca_estimate_normals, signs arbitrary. \param[in] neighbors 3 .. size */
void
cgalPcaNormals(PeerCloud& cloud, unsigned neighbors, unsigned threads);

/** \brief CGAL::mst_orient_normals (one thread): flips normals towards consistency, in order. \param[in] neighbors 2 .. size
 * \return number of normals that it could not orient */
std::size_t
cgalMstOrientNormals(PeerCloud& cloud, unsigned neighbors);

} // namespace pcl_gpf::benchmark_peers
