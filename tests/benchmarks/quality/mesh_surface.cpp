// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_surface.h"

#include <pcl_gpf/core/analysis/surface_sampling.h>
#include <pcl_gpf/core/analysis/triangle_distance.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

namespace pcl_gpf::quality {

namespace {

namespace fs = std::filesystem;

constexpr double kSharpCosine = 0.86602540378443865; // of 30 degrees
constexpr const char* kMeshFolders[] = {"mesh_sharp", "mesh_organic"};

/** Segments with a direction each, and exact distances to them. */
class Segments {
public:
  void
  add(const Position& a, const Position& b, const Position& outward)
  {
    const auto first = static_cast<std::uint32_t>(vertices_.size() / 3);
    vertices_.insert(vertices_.end(), a.begin(), a.end());
    vertices_.insert(vertices_.end(), b.begin(), b.end());
    triangles_.insert(triangles_.end(), {first, first + 1, first + 1}); // a triangle without area counts as a segment
    curves_.push_back(Curve::segment(a, b, outward));
  }
  void
  build()
  {
    if (!triangles_.empty())
      distance_.emplace(vertices_, triangles_);
  }
  double
  distance(const Position& p) const
  {
    return distance_ ? std::abs(distance_->nearest(p).signed_distance) : std::numeric_limits<double>::infinity();
  }
  const std::vector<Curve>&
  curves() const
  {
    return curves_;
  }

private:
  std::vector<double> vertices_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Curve> curves_;
  std::optional<TriangleDistance> distance_;
};

class MeshSurface : public Surface {
public:
  explicit MeshSurface(TriangleMesh mesh)
      : mesh_(std::move(mesh))
      , distance_(mesh_.vertices, mesh_.triangles)
  {
    for (std::size_t v = 0; v < mesh_.vertexCount(); ++v)
      box_.add(vertex(v)[0], vertex(v)[1], vertex(v)[2]);
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const Position n = doubledArea(t);
      area_ += 0.5 * length(n);
      normals_.push_back(normalized(n));
    }
    findEdges();
  }

  BoundingBox
  box() const override
  {
    return box_;
  }
  double
  area() const override
  {
    return area_;
  }
  bool
  closed() const override
  {
    return boundary_.curves().empty();
  }
  std::vector<SurfaceSample>
  sample(std::size_t count, std::uint64_t seed) const override
  {
    std::vector<SurfaceSample> samples;
    for (const Position& p : sampleSurface(mesh_.vertices, mesh_.triangles, count, seed)) {
      const std::uint32_t t = distance_.nearest(p).triangle;
      samples.push_back({p, normals_[t], t});
    }
    return samples;
  }
  SurfaceHit
  nearest(const Position& p) const override
  {
    const TriangleDistance::Nearest found = distance_.nearest(p);
    return {found.signed_distance, normals_[found.triangle], found.triangle};
  }
  double
  edgeDistance(const Position& p) const override
  {
    return edges_.distance(p);
  }
  std::vector<Position>
  edgeSamples(double step) const override
  {
    std::vector<Position> points;
    for (const BoundarySample& s : sampleCurves(edges_.curves(), step))
      points.push_back(s.point);
    return points;
  }
  double
  boundaryDistance(const Position& p) const override
  {
    return boundary_.distance(p);
  }
  std::vector<BoundarySample>
  boundarySamples(double step) const override
  {
    return sampleCurves(boundary_.curves(), step);
  }

private:
  Position
  vertex(std::size_t v) const
  {
    return {mesh_.vertices[3 * v], mesh_.vertices[3 * v + 1], mesh_.vertices[3 * v + 2]};
  }
  Position
  corner(std::size_t t, std::size_t k) const
  {
    return vertex(mesh_.triangles[3 * t + k % 3]);
  }
  Position
  doubledArea(std::size_t t) const
  {
    return cross(subtract(corner(t, 1), corner(t, 0)), subtract(corner(t, 2), corner(t, 0)));
  }

  /** An edge of one face is boundary; of several, sharp when any two of their normals differ enough. */
  void
  findEdges()
  {
    struct Side {
      std::size_t triangle, corner;
    };
    std::map<std::pair<Position, Position>, std::vector<Side>> sides;
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t)
      for (std::size_t k = 0; k < 3 && length(normals_[t]) > 0; ++k) {
        const Position a = corner(t, k), b = corner(t, k + 1);
        sides[{std::min(a, b), std::max(a, b)}].push_back({t, k});
      }
    for (const auto& [ends, faces] : sides) {
      const Side first = faces.front();
      const Position& n = normals_[first.triangle];
      const Position along = subtract(corner(first.triangle, first.corner + 1), corner(first.triangle, first.corner));
      if (faces.size() == 1)
        boundary_.add(ends.first, ends.second, normalized(cross(along, n)));
      else if (std::any_of(faces.begin(), faces.end(),
                           [&](const Side& s) { return dot(n, normals_[s.triangle]) < kSharpCosine; }))
        edges_.add(ends.first, ends.second, {0, 0, 0});
    }
    edges_.build();
    boundary_.build();
  }

  TriangleMesh mesh_;
  TriangleDistance distance_;
  BoundingBox box_;
  double area_ = 0;
  std::vector<Position> normals_; ///< of the triangles; zero without area
  Segments edges_, boundary_;
};

} // namespace

std::shared_ptr<const Surface>
meshSurface(const TriangleMesh& mesh)
{
  return std::make_shared<MeshSurface>(mesh);
}

std::shared_ptr<const Surface>
sharedMeshSurface(const std::string& name)
{
  for (const char* folder : kMeshFolders) {
    const fs::path path = fs::path(PCL_GPF_SHARED_DIR) / "data" / folder / (name + ".ply");
    if (fs::exists(path))
      return meshSurface(readMesh(path.string()));
  }
  throw std::runtime_error("the shared data have no mesh \"" + name + "\"");
}

std::vector<std::string>
sharedMeshNames()
{
  std::vector<std::string> names;
  for (const char* folder : kMeshFolders) {
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(fs::path(PCL_GPF_SHARED_DIR) / "data" / folder, missing))
      if (entry.path().extension() == ".ply")
        names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

} // namespace pcl_gpf::quality
