// SPDX-License-Identifier: BSD-3-Clause
#include "picture_cloud.h"

#include "../console.h"
#include "../positions.h"

#include <pcl_gpf/core/analysis/spacing.h>
#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/plane_normals.h>
#include <pcl_gpf/core/soa_buffer.h>
#include <pcl_gpf/io/errors.h>
#include <pcl_gpf/io/mesh_file.h>

#include <algorithm>
#include <utility>

namespace pcl_gpf {

namespace {

SoaBuffer
localPoints(const PictureCloud& cloud, const LocalFrame& frame)
{
  SoaBuffer local(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    local.x[i] = frame.toLocal(cloud.points[i][0], 0);
    local.y[i] = frame.toLocal(cloud.points[i][1], 1);
    local.z[i] = frame.toLocal(cloud.points[i][2], 2);
  }
  return local;
}

/** Faces of a PLY file, as places among the points shown; empty when it has none. */
std::vector<std::uint32_t>
readTriangles(const PictureCloud& cloud)
{
  const CloudFormat format = cloud.file.format;
  if (format != CloudFormat::PlyAscii && format != CloudFormat::PlyLittleEndian && format != CloudFormat::PlyBigEndian)
    return {};
  TriangleMesh mesh;
  try {
    mesh = readMesh(cloud.path);
  }
  catch (const IoError&) { // no faces, or none that can be used: the points are shown
    return {};
  }
  constexpr std::uint32_t kNotShown = 0xffffffffu;
  std::vector<std::uint32_t> place(cloud.file.size(), kNotShown), triangles;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i)
    place[cloud.rows[i]] = static_cast<std::uint32_t>(i);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t* v = mesh.triangles.data() + t;
    if (place[v[0]] != kNotShown && place[v[1]] != kNotShown && place[v[2]] != kNotShown)
      triangles.insert(triangles.end(), {place[v[0]], place[v[1]], place[v[2]]});
  }
  return triangles;
}

/** Drops the triangles of points that are not kept. */
void
keepTriangles(const std::vector<bool>& kept, std::vector<std::uint32_t>& triangles)
{
  std::vector<std::uint32_t> place(kept.size()), rest;
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    place[i] = kept[i] ? next++ : next;
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    if (kept[triangles[t]] && kept[triangles[t + 1]] && kept[triangles[t + 2]])
      rest.insert(rest.end(), {place[triangles[t]], place[triangles[t + 1]], place[triangles[t + 2]]});
  triangles = std::move(rest);
}

} // namespace

PictureCloud
readPictureCloud(const std::string& path, unsigned threads, Console& console)
{
  LoadedCloud loaded = loadCloud(path, console);
  if (loaded.finite == 0)
    throw UnsuitableData(path + ": no point is finite, there is nothing to show");
  PictureCloud cloud;
  cloud.path = path;
  cloud.box = loaded.box;
  cloud.dense = denseBoxOf(loaded);
  const CloudCoordinates& c = loaded.coordinates;
  for (std::size_t row = 0; row < loaded.file.size(); ++row)
    if (std::isfinite(c.x[row]) && std::isfinite(c.y[row]) && std::isfinite(c.z[row])) {
      cloud.rows.push_back(static_cast<std::uint32_t>(row));
      cloud.points.push_back({c.x[row], c.y[row], c.z[row]});
    }
  cloud.file = std::move(loaded.file);
  cloud.triangles = readTriangles(cloud);
  const LocalFrame frame = localFrame(cloud.box, cloud.dense);
  cloud.index = std::make_shared<const PointIndex>(localPoints(cloud, frame).view(), threads);
  cloud.spacing = frame.lengthToWorld(estimateSpacing(*cloud.index, threads));
  return cloud;
}

bool
hasUsableNormals(const PictureCloud& cloud)
{
  const std::vector<Position> normals = normalsOf(cloud.file);
  return !normals.empty() && std::all_of(cloud.rows.begin(), cloud.rows.end(), [&](std::uint32_t row) {
    const double norm = length(normals[row]);
    return std::isfinite(norm) && norm > 0;
  });
}

void
takeNormals(PictureCloud& cloud)
{
  const std::vector<Position> normals = normalsOf(cloud.file);
  cloud.normals.clear();
  for (const std::uint32_t row : cloud.rows)
    cloud.normals.push_back(normalized(normals[row]));
}

void
estimateNormals(PictureCloud& cloud, double radius, unsigned threads)
{
  const LocalFrame frame = localFrame(cloud.box, cloud.dense);
  SoaBuffer normals(cloud.points.size());
  PlaneNormalsParameters parameters;
  parameters.radius = frame.lengthToLocal(radius);
  parameters.number_of_threads = threads;
  estimatePlaneNormals(parameters, *cloud.index, normals.view());
  cloud.normals.resize(cloud.points.size());
  for (std::size_t k = 0; k < cloud.normals.size(); ++k)
    cloud.normals[cloud.index->order()[k]] = {double{normals.x[k]}, double{normals.y[k]}, double{normals.z[k]}};
}

void
keepOnly(PictureCloud& cloud, const std::function<bool(const Position& point)>& keep)
{
  cloud.index.reset();
  std::size_t kept = 0;
  std::vector<bool> is_kept(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    is_kept[i] = keep(cloud.points[i]);
    if (!is_kept[i])
      continue;
    cloud.points[kept] = cloud.points[i];
    cloud.rows[kept] = cloud.rows[i];
    if (!cloud.normals.empty())
      cloud.normals[kept] = cloud.normals[i];
    ++kept;
  }
  cloud.points.resize(kept);
  cloud.rows.resize(kept);
  if (!cloud.normals.empty())
    cloud.normals.resize(kept);
  keepTriangles(is_kept, cloud.triangles);
}

} // namespace pcl_gpf
