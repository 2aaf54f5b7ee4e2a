// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/shapes.h"

#include <pcl_gpf/io/cloud_file.h>
#include <pcl_gpf/io/read_cloud.h>
#include <pcl_gpf/io/write_cloud.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace pcl_gpf::test {

/** \brief A cloud with x, y, z of one type and nothing else. */
inline CloudFile
toCloudFile(const Shape& shape, FieldType type = FieldType::Float32, const Vector3& offset = {0, 0, 0})
{
  CloudFile cloud;
  cloud.width = static_cast<std::uint32_t>(shape.size());
  for (const char* axis : {"x", "y", "z"})
    cloud.addField(axis, type);
  for (std::size_t i = 0; i < shape.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      cloud.setCoordinate(i, axis, shape.points[i][static_cast<std::size_t>(axis)] + offset[static_cast<std::size_t>(axis)]);
  return cloud;
}

inline void
save(const CloudFile& cloud, const std::string& path)
{
  WriteOptions options;
  options.overwrite = true;
  writeCloud(cloud, path, options);
}

/** \brief Writes a noisy unit cube. \return its path */
inline std::string
saveNoisyCube(const std::string& path, std::size_t count = 3000, double noise = 0.01)
{
  save(toCloudFile(cube(count, noise, 7)), path);
  return path;
}

/** \brief Root mean square distance of the points to the surface of the unit cube. */
inline double
distanceToCube(const CloudFile& cloud)
{
  const CloudCoordinates points = cloud.coordinates();
  double sum = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double outside = 0.0, depth = std::numeric_limits<double>::infinity();
    for (const double value : {points.x[i], points.y[i], points.z[i]}) {
      const double beyond = std::max({-value, value - 1.0, 0.0});
      outside += beyond * beyond;
      depth = std::min(depth, std::min(std::abs(value), std::abs(1.0 - value)));
    }
    sum += outside > 0.0 ? outside : depth * depth;
  }
  return std::sqrt(sum / static_cast<double>(cloud.size()));
}

} // namespace pcl_gpf::test
