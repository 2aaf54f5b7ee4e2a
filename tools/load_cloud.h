// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/parameter_estimation.h>
#include <pcl_gpf/core/local_frame.h>
#include <pcl_gpf/io/cloud_file.h>

#include <cstddef>
#include <string>

namespace pcl_gpf {

class Console;

/** \brief A cloud as read, with its coordinates in double and what can be counted at once. */
struct LoadedCloud {
  CloudFile file;
  CloudCoordinates coordinates; ///< file.size() values an axis
  std::size_t finite = 0;       ///< points whose x, y and z are finite
  BoundingBox box;              ///< of the finite points
};

/** \brief Reads a cloud and passes the reader's warnings on. \throws IoError (kind Unreadable) */
LoadedCloud
loadCloud(const std::string& path, Console& console);

/** \brief Counts and measures the coordinates of a cloud. */
LoadedCloud
inspectCloud(CloudFile file);

/** \brief Refuses what no command can work on. \throws UnsuitableData: no points, none finite, all at one place */
void
requireUsable(const LoadedCloud& cloud);

/** \brief Box of the dense part of the finite points (denseBox()), which one that strayed far does not widen. */
BoundingBox
denseBoxOf(const LoadedCloud& cloud);

/** \brief Spacing, noise, diagonal and h0 of the finite points in cloud units; zeros for fewer than 2 different points. */
CloudScale
measureCloud(const LoadedCloud& cloud, unsigned threads);

} // namespace pcl_gpf
