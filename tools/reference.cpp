// SPDX-License-Identifier: BSD-3-Clause
#include "reference.h"

#include "console.h"
#include "positions.h"

#include <pcl_gpf/core/analysis/surface_sampling.h>
#include <pcl_gpf/core/errors.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace pcl_gpf {

namespace {

bool
endsWith(std::string text, const std::string& ending)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.size() >= ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/** Whether the header of a PLY file promises faces. Any other file: no. */
bool
isPlyWithFaces(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string header(1 << 20, '\0');
  file.read(&header[0], static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(file.gcount()));
  if (header.compare(0, 3, "ply") != 0)
    return false;
  std::replace(header.begin(), header.end(), '\r', '\n'); // any of the three kinds of line end
  std::istringstream lines(header);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword, name, count;
    words >> keyword >> name >> count;
    if (keyword == "end_header")
      return false;
    if (keyword == "element" && name == "face")
      return count.find_first_of("123456789") != std::string::npos;
  }
  return false;
}

bool
looksLikeMesh(const std::string& path)
{
  return endsWith(path, ".off") || endsWith(path, ".obj") || isPlyWithFaces(path);
}

} // namespace

Reference::Reference(const std::string& path, Kind kind, Console& console)
{
  BoundingBox box;
  if (kind == Kind::Surface || (kind == Kind::Auto && looksLikeMesh(path))) {
    mesh_ = readMesh(path);
    for (std::size_t i = 0; i + 2 < mesh_->vertices.size(); i += 3)
      points_.push_back({mesh_->vertices[i], mesh_->vertices[i + 1], mesh_->vertices[i + 2]});
    for (const std::uint32_t vertex : mesh_->triangles) // unused vertices do not count
      box.add(points_[vertex][0], points_[vertex][1], points_[vertex][2]);
  } else {
    const LoadedCloud cloud = loadCloud(path, console);
    if (cloud.finite == 0)
      throw UnsuitableData(path + ": no point to measure against is finite");
    points_ = positionsOf(cloud.coordinates);
    box = cloud.box;
  }
  diagonal_ = box.diagonal();
}

std::size_t
Reference::size() const
{
  return mesh_ ? mesh_->triangleCount() : points_.size();
}

std::vector<double>
Reference::distances(const std::vector<Position>& queries, unsigned threads) const
{
  if (mesh_)
    return TriangleDistance(mesh_->vertices, mesh_->triangles).signedDistances(queries, threads);
  return PointDistance(points_).distances(queries, threads);
}

std::vector<Position>
Reference::samples(std::size_t count, std::uint64_t seed) const
{
  return mesh_ ? sampleSurface(mesh_->vertices, mesh_->triangles, count, seed) : points_;
}

} // namespace pcl_gpf
