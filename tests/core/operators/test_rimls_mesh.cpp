// SPDX-License-Identifier: BSD-3-Clause
#include "support/implicit_shapes.h"
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/rimls_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

namespace pcl_gpf::test {
namespace {

SurfaceMesh
meshOf(const LocalCloud& cloud, RimlsMeshParameters p, unsigned resolution, RimlsMeshStatistics* statistics = nullptr)
{
  p.resolution = resolution;
  return meshRimls(p, cloud.points.view(), cloud.normals.view(), {}, statistics);
}

void
expectClosed(const SurfaceMesh& mesh, std::int64_t euler, const std::string& what)
{
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_EQ(topology.open_edges, 0u) << what;
  EXPECT_EQ(topology.inconsistent_edges, 0u) << what;
  EXPECT_EQ(topology.components, 1u) << what;
  EXPECT_EQ(topology.euler_characteristic, euler) << what;
}

/** Share of faces whose corner normals they do not look along. */
double
turnedFaces(const SurfaceMesh& mesh)
{
  std::size_t turned_faces = 0;
  const SoaBuffer& v = mesh.vertices;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::size_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
    const double u[3] = {v.x[b] - v.x[a], v.y[b] - v.y[a], v.z[b] - v.z[a]}, w[3] = {v.x[c] - v.x[a], v.y[c] - v.y[a], v.z[c] - v.z[a]};
    const double n[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    double along = 0;
    for (const std::size_t k : {a, b, c})
      along += n[0] * mesh.normals.x[k] + n[1] * mesh.normals.y[k] + n[2] * mesh.normals.z[k];
    turned_faces += along < 0;
  }
  return static_cast<double>(turned_faces) / static_cast<double>(mesh.triangleCount());
}

TEST(RimlsMesh, isClosedAndOfTheRightTopologyWithoutNoise)
{
  RimlsMeshParameters p;
  p.largest_hole = 0; // there must be none to fill
  for (const std::uint64_t seed : {1u, 2u}) {
    const LocalCloud ball = toLocalCloud(turned(sphere(8000, 0, seed))), ring = toLocalCloud(turned(torus(8000, 0, seed))),
                     box = toLocalCloud(turned(block(8000, 0, seed))), straight_box = toLocalCloud(block(2000, 0, seed));
    for (const unsigned resolution : {25u, 60u, 120u}) {
      const std::string at = " of seed " + std::to_string(seed) + " at " + std::to_string(resolution);
      expectClosed(meshOf(ball, p, resolution), 2, "sphere" + at);
      expectClosed(meshOf(ring, p, resolution), 0, "torus" + at);
      expectClosed(meshOf(box, p, resolution), 2, "block" + at);
      expectClosed(meshOf(straight_box, p, resolution), 2, "straight block" + at);
    }
  }
}

TEST(RimlsMesh, verticesLieOnTheSurfaceAndFacesLookAlongNormals)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(10000)));
  RimlsMeshStatistics statistics;
  const SurfaceMesh mesh = meshOf(cloud, {}, 100, &statistics);
  const double radius = 0.5 / std::sqrt(3.0); // the box diagonal is 1
  for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
    EXPECT_NEAR(distance({mesh.vertices.x[i], mesh.vertices.y[i], mesh.vertices.z[i]}, {0, 0, 0}), radius, 0.02 * radius);
  EXPECT_LT(turnedFaces(mesh), 1e-4);
  EXPECT_LT(turnedFaces(meshOf(toLocalCloud(turned(block(10000))), {}, 100)), 1e-3);
  RimlsParameters rimls; // as the mesher sets it: cells of 0.6 spacings
  const double least = 0.9 * statistics.cell_size + statistics.spacing, natural = 1.128 * statistics.spacing;
  rimls.minimum_radius = least;
  rimls.scale = 6 * natural / least;
  const RimlsSurface surface(rimls, cloud.points.view(), cloud.normals.view());
  std::vector<float> value(mesh.vertexCount());
  surface.evaluate(mesh.vertices.view(), {value.data(), {}, nullptr});
  for (const float f : value)
    EXPECT_LE(std::abs(f), 1e-3 * surface.spacing());
  EXPECT_GT(statistics.mean_vertex_movement, 0.0);
  EXPECT_LT(statistics.mean_vertex_movement, 0.1 * statistics.cell_size);
}

TEST(RimlsMesh, projectionIsOptional)
{
  const LocalCloud cloud = toLocalCloud(turned(block(6000)));
  RimlsMeshParameters p;
  p.project_vertices = false;
  const SurfaceMesh plain = meshOf(cloud, p, 60), projected = meshOf(cloud, {}, 60);
  EXPECT_EQ(plain.triangles, projected.triangles);
  EXPECT_FALSE(sameBits(plain.vertices, projected.vertices));
  EXPECT_EQ(plain.normals.size(), plain.vertexCount());
}

TEST(RimlsMesh, anOpenSheetHasABorderAndNoBack)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(6000)));
  RimlsMeshStatistics statistics;
  const SurfaceMesh mesh = meshOf(cloud, {}, 80, &statistics);
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler_characteristic, 1);
  EXPECT_GT(topology.open_edges, 200u);
  EXPECT_EQ(topology.inconsistent_edges, 0u);
  // The square and two local radii beyond it, nothing else.
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    Vector3 corner[3];
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = {mesh.vertices.x[mesh.triangles[t + k]], mesh.vertices.y[mesh.triangles[t + k]], mesh.vertices.z[mesh.triangles[t + k]]};
    const double a = distance(corner[0], corner[1]), b = distance(corner[1], corner[2]), c = distance(corner[2], corner[0]), s = (a + b + c) / 2;
    area += std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
  }
  const double square = 6000 * statistics.spacing * statistics.spacing;
  EXPECT_GT(area, 0.95 * square);
  EXPECT_LT(area, 1.25 * square);
}

TEST(RimlsMesh, partsFarApartAreAllFoundAndSmallOnesRemoved)
{
  Shape shape = sphere(6000);
  const Shape small = sphere(400, 0, 2);
  for (std::size_t i = 0; i < small.size(); ++i)
    append(shape, {0.2 * small.points[i][0] + 1.5, 0.2 * small.points[i][1], 0.2 * small.points[i][2]}, small.normals[i]);
  const LocalCloud cloud = toLocalCloud(turned(shape));
  RimlsMeshParameters all;
  all.smallest_component = 0;
  EXPECT_EQ(meshTopology(meshOf(cloud, all, 120)).components, 2u);
  RimlsMeshParameters large;
  large.smallest_component = 0.1;
  RimlsMeshStatistics statistics;
  expectClosed(meshOf(cloud, large, 120, &statistics), 2, "the large sphere alone");
  EXPECT_EQ(statistics.removed_components, 1u);
}

TEST(RimlsMesh, aFarOutlierDoesNotCoarsenTheRest)
{
  Shape shape = turned(sphere(6000));
  append(shape, {400, 0, 0}, {1, 0, 0});
  RimlsMeshStatistics statistics;
  const SurfaceMesh mesh = meshOf(toLocalCloud(shape), {}, 50, &statistics);
  expectClosed(mesh, 2, "sphere beside an outlier");
  EXPECT_GT(mesh.triangleCount(), 8000u);
}

TEST(RimlsMesh, hasTheSameBitsForAnyNumberOfThreads)
{
  const LocalCloud cloud = toLocalCloud(turned(block(6000, 0.004, 3)));
  RimlsMeshParameters p;
  p.number_of_threads = 1;
  const SurfaceMesh expected = meshOf(cloud, p, 70);
  for (const unsigned threads : {2u, 5u}) {
    p.number_of_threads = threads;
    const SurfaceMesh mesh = meshOf(cloud, p, 70);
    EXPECT_EQ(mesh.triangles, expected.triangles);
    EXPECT_TRUE(sameBits(mesh.vertices, expected.vertices));
    EXPECT_TRUE(sameBits(mesh.normals, expected.normals));
  }
}

TEST(RimlsMesh, refusesAResolutionThatTakesTooMuchMemoryAndNamesIt)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(2000)));
  try {
    meshOf(cloud, {}, 20000);
    FAIL();
  } catch (const ExcessiveWork& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("20000"), std::string::npos) << text;
    EXPECT_NE(text.find("2 GiB"), std::string::npos) << text;
  }
}

TEST(RimlsMesh, refusesASupportRadiusThatHoldsEverythingAtOnceAndSaysWhatItWouldTake)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(60000)));
  RimlsMeshParameters wide, wide_scale;
  wide.rimls.radius = 1e9;
  wide_scale.rimls.scale = 100.0;
  for (const RimlsMeshParameters& p : {wide, wide_scale}) {
    const auto start = std::chrono::steady_clock::now();
    try {
      meshOf(cloud, p, 300);
      FAIL();
    } catch (const ExcessiveWork& error) {
      EXPECT_NE(std::string(error.what()).find("billion pairs"), std::string::npos) << error.what();
    }
    EXPECT_THROW(checkMeshMemory(p, cloud.points.view()), ExcessiveWork);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20.0); // 0.1 s; minutes without
  }
  wide.resolution = 20; // few cells may take wide supports
  EXPECT_GT(checkMeshMemory(wide, cloud.points.view()), 0.0);
}

TEST(RimlsMesh, refusesCloudsWithoutSurfaceAndBadParameters)
{
  for (const std::size_t size : {0u, 1u, 2u, 3u, 50u}) {
    std::vector<Vector3> points(size, {0.1, 0.2, 0.3}), normals(size, {0, 0, 1});
    const SoaBuffer p = toBuffer(points), n = toBuffer(normals);
    EXPECT_THROW(meshRimls({}, p.view(), n.view()), UnsuitableData) << size;
  }
  const auto refused = [](const auto& change) {
    RimlsMeshParameters p;
    change(p);
    EXPECT_THROW(validate(p), InvalidParameter);
  };
  refused([](RimlsMeshParameters& p) { p.resolution = 1; });
  refused([](RimlsMeshParameters& p) { p.resolution = 70000; });
  refused([](RimlsMeshParameters& p) { p.cell_size = -1; });
  refused([](RimlsMeshParameters& p) { p.smallest_component = 2; });
  refused([](RimlsMeshParameters& p) { p.largest_hole = 1001; });
  refused([](RimlsMeshParameters& p) { p.memory_limit = 0; });
  refused([](RimlsMeshParameters& p) { p.rimls.scale = 0; });
}

TEST(RimlsMesh, refusesPointsOnALine)
{
  std::vector<Vector3> points, normals;
  for (int i = 0; i < 200; ++i) {
    points.push_back({0.005 * i - 0.5, 0, 0});
    normals.push_back({0, 0, 1});
  }
  const SoaBuffer p = toBuffer(points), n = toBuffer(normals);
  EXPECT_THROW(meshRimls({}, p.view(), n.view()), UnsuitableData);
  EXPECT_THROW(checkMeshMemory({}, p.view()), UnsuitableData);
}

TEST(RimlsMesh, canBeCancelledAnywhereAndProgressRises)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(2000)));
  std::vector<double> fractions;
  RimlsMeshParameters p;
  p.resolution = 40;
  meshRimls(p, cloud.points.view(), cloud.normals.view(), [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  for (const double stop : {0.0, 0.1, 0.5, 0.9, 1.0})
    EXPECT_THROW(meshRimls(p, cloud.points.view(), cloud.normals.view(), [&](double fraction) { return fraction < stop; }), Cancelled);
}

} // namespace
} // namespace pcl_gpf::test
