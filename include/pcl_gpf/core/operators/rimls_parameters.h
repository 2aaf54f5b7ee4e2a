// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/export.h>

namespace pcl_gpf {

/** \brief Parameters of RIMLS (Oeztireli, Guennebaud, Gross, Eurographics 2009). Lengths are in the unit of the points
 * they are used with: cloud units in RIMLSProjection<PointT>, MarchingCubesRIMLS<PointT> and the tool, the normalised
 * frame in the core. */
struct RimlsParameters {
  /** Support radius of a sample in units of its local radius, h_i = scale r_i, 1 .. 100; r_i is half the distance of
   * the 16th nearest point, itself counted, about 1.1 spacings. Smaller: detail and noise stay. Larger: smoother,
   * convex parts inflate, time grows with its square. MeshLab's FilterScale. */
  double scale = 4.0;

  /** Support radius h of all samples instead, >= 0; 0 = from `scale`. The local radius is then radius / scale. */
  double radius = 0.0;

  /** Least local radius r_i, >= 0. A mesher sets it to its cell, below which there is nothing to resolve. */
  double minimum_radius = 0.0;

  /** Width sigma_n of the weight of normals, > 0; unit normals differ by at most 2. 0.5 keeps edges sharp, 1.5 and more
   * is smooth. */
  double sigma_n = 0.75;

  /** Width sigma_r of the weight of residuals as a share of h_i, >= 0; 0 = off, which is what MeshLab computes. The
   * paper: 0.5. */
  double sigma_r = 0.0;

  /** Fits of each value, 1 .. 100: the first is plain IMLS, the others are robust. */
  unsigned fits = 3;

  /** Largest number of steps of a projection, 1 .. 1000. */
  unsigned maximum_iterations = 15;

  /** A projection ends when |f| is at most this share of the spacing, > 0. */
  double accuracy = 1e-4;

  /** Fewest samples that must reach a position for f to be defined there, >= 1. */
  unsigned minimum_samples = 4;

  /** One of them must be nearer than this many local radii r_i, > 0. */
  double domain = 2.0;

  /** Threads, 0 = all that the process may use. The result does not depend on it. */
  unsigned number_of_threads = 0;
};

/** \brief Checks every range. \throws InvalidParameter naming field, value and range */
PCL_GPF_CORE_EXPORT void
validate(const RimlsParameters& parameters);

} // namespace pcl_gpf
