// SPDX-License-Identifier: BSD-3-Clause
#include "load_cloud.h"

#include "console.h"

#include <pcl_gpf/core/dense_box.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/io/read_cloud.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pcl_gpf {

namespace {

bool
isFinite(const CloudCoordinates& points, std::size_t i)
{
  return std::isfinite(points.x[i]) && std::isfinite(points.y[i]) && std::isfinite(points.z[i]);
}

bool
hasExtent(const LoadedCloud& cloud)
{
  const double diagonal = cloud.box.diagonal();
  return diagonal > 0.0 && std::isfinite(diagonal);
}

SoaBuffer
finitePoints(const LoadedCloud& cloud, const LocalFrame& frame)
{
  SoaBuffer local(cloud.finite);
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.file.size(); ++i) {
    if (!isFinite(cloud.coordinates, i))
      continue;
    local.x[count] = frame.toLocal(cloud.coordinates.x[i], 0);
    local.y[count] = frame.toLocal(cloud.coordinates.y[i], 1);
    local.z[count] = frame.toLocal(cloud.coordinates.z[i], 2);
    ++count;
  }
  return local;
}

} // namespace

LoadedCloud
inspectCloud(CloudFile file)
{
  LoadedCloud cloud;
  cloud.file = std::move(file);
  cloud.coordinates = cloud.file.coordinates();
  for (std::size_t i = 0; i < cloud.file.size(); ++i)
    if (isFinite(cloud.coordinates, i))
      cloud.box.add(cloud.coordinates.x[i], cloud.coordinates.y[i], cloud.coordinates.z[i]);
  cloud.finite = cloud.box.count;
  return cloud;
}

LoadedCloud
loadCloud(const std::string& path, Console& console)
{
  LoadedCloud cloud = inspectCloud(readCloud(path));
  for (const std::string& warning : cloud.file.warnings)
    console.warn(warning);
  return cloud;
}

void
requireUsable(const LoadedCloud& cloud)
{
  if (cloud.file.size() == 0)
    throw UnsuitableData("the cloud has no points");
  if (cloud.finite == 0)
    throw UnsuitableData("none of the " + std::to_string(cloud.file.size()) + " points has finite coordinates");
  if (cloud.box.min == cloud.box.max)
    throw UnsuitableData("all " + std::to_string(cloud.finite) + " finite points are at one place");
}

BoundingBox
denseBoxOf(const LoadedCloud& cloud)
{
  if (!hasExtent(cloud))
    return cloud.box;
  std::vector<std::size_t> rows;
  rows.reserve(cloud.finite);
  for (std::size_t i = 0; i < cloud.file.size(); ++i)
    if (isFinite(cloud.coordinates, i))
      rows.push_back(i);
  const std::array<const std::vector<double>*, 3> axes{&cloud.coordinates.x, &cloud.coordinates.y, &cloud.coordinates.z};
  return denseBox(cloud.box, rows.size(), [&](std::size_t k, std::size_t axis) { return (*axes[axis])[rows[k]]; });
}

CloudScale
measureCloud(const LoadedCloud& cloud, unsigned threads)
{
  if (!hasExtent(cloud))
    return {};
  const LocalFrame frame = localFrame(cloud.box, denseBoxOf(cloud));
  CloudScale scale = measureScale(finitePoints(cloud, frame).view(), threads);
  scale.spacing = frame.lengthToWorld(scale.spacing);
  scale.noise = frame.lengthToWorld(scale.noise);
  scale.h0 = frame.lengthToWorld(scale.h0);
  scale.diagonal = frame.scale;
  return scale;
}

} // namespace pcl_gpf
