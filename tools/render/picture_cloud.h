// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../load_cloud.h"
#include "camera.h"

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/point_index.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl_gpf {

class Console;

/** \brief The points of a file that a picture shows. */
struct PictureCloud {
  std::string path;
  CloudFile file;
  BoundingBox box;                  ///< of all finite points
  BoundingBox dense;                ///< of them without those that lie far away from all others
  double spacing = 0;               ///< of the file's points, cloud units
  std::vector<std::uint32_t> rows;  ///< rows of the file that are shown, finite
  std::vector<Position> points;     ///< their positions
  std::vector<Position> normals;    ///< unit or zero, one per point; empty until set
  std::vector<std::uint32_t> triangles; ///< of a mesh, three places in `points` each; empty for a cloud
  std::shared_ptr<const PointIndex> index; ///< of the points in the frame of the boxes; gone after keepOnly()
};

/** \brief Reads a cloud, or a mesh (a PLY file with faces); all its finite points are shown. \throws IoError (kind Unreadable), UnsuitableData if there is none */
PictureCloud
readPictureCloud(const std::string& path, unsigned threads, Console& console);

/** \brief Whether the file has a usable normal for every point shown. */
bool
hasUsableNormals(const PictureCloud& cloud);

/** \brief Takes the normals of the file. */
void
takeNormals(PictureCloud& cloud);

/** \brief Fits planes in balls of `radius` (cloud units) to the points; before keepOnly(). */
void
estimateNormals(PictureCloud& cloud, double radius, unsigned threads);

/** \brief Shows only the points for which `keep` is true. */
void
keepOnly(PictureCloud& cloud, const std::function<bool(const Position& point)>& keep);

} // namespace pcl_gpf
