// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/export.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_gpf {

/** \brief Exact signed distances to a triangle mesh, in double precision.
 *
 * The sign is that of the face normal where the nearest point lies inside a face, and of the angle-weighted pseudonormal where it
 * lies on an edge or a vertex; on a closed, outward oriented mesh this is always right (Baerentzen and Aanaes, "Signed distance
 * computation using the angle weighted pseudonormal", TVCG 2005). Vertices at the same position count as one.
 * \note On an open mesh the sign tells the side of the nearest sheet; on an inconsistently oriented one it means nothing.
 * Build O(T log T), a query O(log T) on typical data; about 350 bytes a triangle. Copies share the tree.
 * Thread safety: all queries are const and may run concurrently.
 */
class PCL_GPF_CORE_EXPORT TriangleDistance {
public:
  /** \brief The nearest point of the surface. */
  struct Nearest {
    std::uint32_t triangle = 0; ///< its triangle; of several that share the point, always the same one
    Position point{0, 0, 0};
    double signed_distance = 0; ///< below 0 on the inside; its magnitude is the distance
  };

  /** \param[in] vertices x y z per vertex, measurable (isMeasurable())
   * \param[in] triangles three vertex numbers per triangle, counter-clockwise seen from outside; triangles without area count as
   * segments or points
   * \throws InvalidParameter on vertex numbers that do not exist and vertices that are not measurable, UnsuitableData without triangles
   */
  TriangleDistance(const std::vector<double>& vertices, const std::vector<std::uint32_t>& triangles);

  /** \brief Nearest surface point to a measurable `query`. */
  Nearest
  nearest(const Position& query) const;

  /** \brief Signed distance of every query; NaN for queries that are not measurable. The result does not depend on the threads (0 =
   * all). */
  std::vector<double>
  signedDistances(const std::vector<Position>& queries, unsigned number_of_threads = 0) const;

private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

} // namespace pcl_gpf
