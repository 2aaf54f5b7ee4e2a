// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "load_cloud.h"

#include <pcl_gpf/core/analysis/point_distance.h>
#include <pcl_gpf/core/analysis/triangle_distance.h>
#include <pcl_gpf/io/mesh_file.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl_gpf {

class Console;

/** \brief What a cloud is measured against: another cloud, or the surface of a mesh. */
class Reference {
public:
  enum class Kind { Auto, Points, Surface };

  /** \param[in] kind Auto: the surface of a PLY with faces, OFF or OBJ, else the points
   * \throws IoError (kind Unreadable), UnsuitableData (no finite point, no triangle) */
  Reference(const std::string& path, Kind kind, Console& console);

  bool isMesh() const { return mesh_.has_value(); }
  /** \brief Of the bounding box, cloud units; 0 for a single place. */
  double diagonal() const { return diagonal_; }
  /** \brief Points, or triangles. */
  std::size_t size() const;
  /** \brief Points by row, NaN included; for a mesh its vertices. */
  const std::vector<Position>& points() const { return points_; }

  /** \brief Distance of each query, signed for a mesh; NaN for queries that are not finite. */
  std::vector<double>
  distances(const std::vector<Position>& queries, unsigned threads) const;

  /** \brief Positions for the way back: the points, or `count` samples of the surface. */
  std::vector<Position>
  samples(std::size_t count, std::uint64_t seed) const;

private:
  std::vector<Position> points_;
  std::optional<TriangleMesh> mesh_;
  double diagonal_ = 0;
};

} // namespace pcl_gpf
