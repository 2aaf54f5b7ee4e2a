// SPDX-License-Identifier: BSD-3-Clause
#include "support/implicit_shapes.h"
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/marching_cubes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_gpf::test {
namespace {

constexpr double kNotDefined = std::numeric_limits<double>::quiet_NaN();

MarchingCubesParameters
cells(double size)
{
  MarchingCubesParameters p;
  p.cell_size = size;
  p.origin = {0.0137, -0.0021, 0.0073}; // nothing falls on a corner
  return p;
}

SurfaceMesh
meshOf(const ScalarField& field, double cell_size, const std::vector<Vector3>& seeds, MarchingCubesStatistics* statistics = nullptr)
{
  const SoaBuffer at = toBuffer(seeds);
  return extractSurface(cells(cell_size), implicitFunction(field), at.view(), {}, statistics);
}

void
expectClosed(const SurfaceMesh& mesh, std::int64_t euler, std::size_t components = 1)
{
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_EQ(topology.open_edges, 0u);
  EXPECT_EQ(topology.inconsistent_edges, 0u);
  EXPECT_EQ(topology.components, components);
  EXPECT_EQ(topology.euler_characteristic, euler);
}

Vector3
vertex(const SurfaceMesh& mesh, std::size_t v)
{
  return {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]};
}

/** Six times the enclosed volume; positive when faces are counterclockwise seen from outside. */
double
signedVolume(const SurfaceMesh& mesh)
{
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const Vector3 a = vertex(mesh, mesh.triangles[t]), b = vertex(mesh, mesh.triangles[t + 1]), c = vertex(mesh, mesh.triangles[t + 2]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

TEST(MarchingCubes, makeClosedSurfacesOfTheRightTopology)
{
  for (const double size : {0.2, 0.07, 0.02}) {
    expectClosed(meshOf(sphereField, size, {{0.5, 0, 0}}), 2);
    expectClosed(meshOf(blockField, size, {{0.4, 0, 0}}), 2);
    if (size < 0.1)
      expectClosed(meshOf(torusField, size, {{0.48, 0, 0}}), 0);
  }
}

TEST(MarchingCubes, vertexPositionsNormalsAndVolumeAreThoseOfTheSphere)
{
  const SurfaceMesh mesh = meshOf(sphereField, 0.02, {{0, 0, 0.5}});
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vector3 p = vertex(mesh, v), n = {mesh.normals.x[v], mesh.normals.y[v], mesh.normals.z[v]};
    EXPECT_NEAR(distance(p, {0, 0, 0}), 0.5, 2e-4); // linear along an edge: within size^2 / (8 R)
    EXPECT_LE(distance(n, {p[0] * 2, p[1] * 2, p[2] * 2}), 2e-3);
  }
  EXPECT_NEAR(signedVolume(mesh), 4.0 / 3 * 3.14159265358979 / 8, 2e-3);
}

/** A number in [-1, 1) that depends on all bits of the position, the same on every call. */
double
hashedNoise(const Vector3& p)
{
  std::uint64_t state = 1;
  for (const double component : p) {
    const auto rounded = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(component * 1e6)));
    state = SplitMix64(state ^ rounded).next();
  }
  return static_cast<double>(state >> 11) / 4503599627370496.0 - 1.0;
}

TEST(MarchingCubes, areManifoldAndClosedOnNoiseWithEveryCase)
{
  // Random signs at every corner within a ball, outside around it: all 256 cases and all ambiguous faces side by side.
  std::size_t vertices = 0;
  for (const double share : {0.0, 0.2, -0.3}) {
    const ScalarField field = [share](const Vector3& p) { return std::hypot(p[0], p[1], p[2]) > 0.4 ? 1.0 : hashedNoise(p) + share; };
    std::vector<Vector3> seeds;
    for (double x = -0.45; x < 0.45; x += 0.02)
      for (double y = -0.45; y < 0.45; y += 0.02)
        for (double z = -0.45; z < 0.45; z += 0.02)
          seeds.push_back({x, y, z});
    MarchingCubesStatistics statistics;
    const SurfaceMesh mesh = meshOf(field, 0.02, seeds, &statistics);
    const MeshTopology topology = meshTopology(mesh);
    EXPECT_EQ(topology.open_edges, 0u);
    EXPECT_EQ(topology.inconsistent_edges, 0u);
    EXPECT_GT(statistics.cells, 30000u);
    EXPECT_EQ(topology.euler_characteristic % 2, 0);
    vertices += mesh.vertexCount();
  }
  EXPECT_GT(vertices, 100000u);
}

TEST(MarchingCubes, followOnlyThePartsThatSeedsTouch)
{
  const ScalarField two = [](const Vector3& p) {
    return std::min(sphereField(p), sphereField({p[0] - 2, p[1], p[2]}));
  };
  expectClosed(meshOf(two, 0.05, {{0.5, 0, 0}}), 2, 1);
  expectClosed(meshOf(two, 0.05, {{0.5, 0, 0}, {2.5, 0, 0}}), 4, 2);
  EXPECT_EQ(meshOf(two, 0.05, {{9, 9, 9}}).triangleCount(), 0u);
  EXPECT_EQ(meshOf(two, 0.05, {}).vertexCount(), 0u);
}

TEST(MarchingCubes, endWhereTheFunctionDoes)
{
  const ScalarField half = [](const Vector3& p) { return p[0] > 0.2 ? kNotDefined : sphereField(p); };
  MarchingCubesStatistics statistics;
  const SurfaceMesh mesh = meshOf(half, 0.02, {{-0.5, 0, 0}}, &statistics);
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_GT(topology.open_edges, 0u);
  EXPECT_EQ(topology.inconsistent_edges, 0u);
  EXPECT_EQ(topology.euler_characteristic, 1); // a disc
  EXPECT_GT(statistics.skipped_cells, 0u);
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_LE(mesh.vertices.x[v], 0.2f);
}

TEST(MarchingCubes, workIsProportionalToTheSurface)
{
  MarchingCubesStatistics coarse, fine;
  meshOf(sphereField, 0.02, {{0.5, 0, 0}}, &coarse);
  meshOf(sphereField, 0.005, {{0.5, 0, 0}}, &fine);
  EXPECT_NEAR(static_cast<double>(fine.corners) / static_cast<double>(coarse.corners), 16, 1);
  EXPECT_LT(fine.corners, 4 * fine.cells);
}

TEST(MarchingCubes, giveTheSameBitsForAnyThreadsAndOrderOfSeeds)
{
  const ImplicitFunction function = implicitFunction(torusField);
  MarchingCubesParameters p = cells(0.01);
  p.number_of_threads = 1;
  const SoaBuffer seeds = toBuffer({{0.48, 0, 0}, {-0.48, 0, 0}}), others = toBuffer({{0, 0.48, 0}});
  const SurfaceMesh expected = extractSurface(p, function, seeds.view());
  p.number_of_threads = 4;
  const SurfaceMesh mesh = extractSurface(p, function, others.view());
  EXPECT_TRUE(sameBits(mesh.vertices, expected.vertices));
  EXPECT_TRUE(sameBits(mesh.normals, expected.normals));
  EXPECT_EQ(mesh.triangles, expected.triangles);
}

TEST(MarchingCubes, cornersOnTheSurfaceLeaveNoHole)
{
  const ScalarField plane_through_corners = [](const Vector3& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) - 0.5; };
  MarchingCubesParameters p;
  p.cell_size = 0.125; // exact in float: f is exactly 0 at corners
  const SoaBuffer seeds = toBuffer({{0.5, 0.01, 0.01}, {0.499, 0.01, 0.01}, {0.51, 0.01, 0.01}});
  expectClosed(extractSurface(p, implicitFunction(plane_through_corners), seeds.view()), 2);
}

TEST(MarchingCubes, refuseWhatCannotBe)
{
  const ImplicitFunction function = implicitFunction(sphereField);
  const SoaBuffer seeds = toBuffer({{0.5, 0, 0}});
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(extractSurface(cells(bad), function, seeds.view()), InvalidParameter);
  EXPECT_THROW(extractSurface(cells(1e-7), function, seeds.view()), InvalidParameter);
  MarchingCubesParameters small = cells(0.005);
  small.memory_limit = 1 << 20;
  try {
    extractSurface(small, function, seeds.view());
    FAIL() << "a megabyte does not hold this sphere";
  } catch (const ExcessiveWork& error) {
    EXPECT_NE(std::string(error.what()).find("GiB"), std::string::npos) << error.what();
  }
  EXPECT_THROW(extractSurface(cells(0.02), function, seeds.view(), [](double fraction) { return fraction < 0.3; }), Cancelled);
}

TEST(MeshTrim, removesWhatIsFarFromAllPointsOrNotFinite)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const SoaBuffer corners = toBuffer({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}});
  const PointIndex points(corners.view());
  const auto trimmed = [&points](double distance) {
    SurfaceMesh mesh;
    mesh.vertices = toBuffer(
        {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {kNotDefined, 0, 0}, {0, kInfinity, 0}, {0.3, 0, 0}, {1e30, 0, 0}, {0.1, 0.1, 0}});
    mesh.triangles = {0, 1, 2, 1, 3, 2, 1, 4, 2, 1, 5, 2, 1, 6, 2, 1, 1, 2, 1, 7, 2};
    trimMesh(mesh, points, distance);
    return mesh;
  };
  const SurfaceMesh near = trimmed(0.1), finite = trimmed(kInfinity);
  EXPECT_EQ(near.triangles, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  ASSERT_EQ(near.vertexCount(), 4u);
  EXPECT_EQ(near.vertices.y[3], 0.1f);
  EXPECT_EQ(finite.triangleCount(), 4u);
  EXPECT_EQ(finite.vertexCount(), 6u);
}

TEST(MarchingCubes, progressRisesToOne)
{
  const SoaBuffer seeds = toBuffer({{0.5, 0, 0}});
  std::vector<double> fractions;
  extractSurface(cells(0.02), implicitFunction(sphereField), seeds.view(), [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(SurfaceMesh, smallComponentsGoAndTheOthersStay)
{
  const ScalarField two = [](const Vector3& p) {
    return std::min(sphereField(p), 0.3 * sphereField({(p[0] - 2) / 0.3, p[1] / 0.3, p[2] / 0.3}));
  };
  const SurfaceMesh both = meshOf(two, 0.02, {{0.5, 0, 0}, {2.15, 0, 0}}), one = meshOf(sphereField, 0.02, {{0.5, 0, 0}});
  ASSERT_EQ(meshTopology(both).components, 2u); // of areas 1 and 0.09
  SurfaceMesh mesh = meshOf(two, 0.02, {{0.5, 0, 0}, {2.15, 0, 0}});
  EXPECT_EQ(removeSmallComponents(mesh, 0.05), 0u);
  EXPECT_EQ(mesh.triangles, both.triangles);
  EXPECT_EQ(removeSmallComponents(mesh, 0.2), 1u);
  expectClosed(mesh, 2);
  EXPECT_EQ(mesh.triangleCount(), one.triangleCount());
  EXPECT_TRUE(sameBits(mesh.vertices, one.vertices));
  EXPECT_EQ(mesh.normals.size(), mesh.vertexCount());
  EXPECT_THROW(removeSmallComponents(mesh, 1.5), InvalidParameter);
  SurfaceMesh empty;
  EXPECT_EQ(removeSmallComponents(empty, 0.5), 0u);
}

TEST(SurfaceMesh, smallHolesAreClosedAndRimsAreNot)
{
  const ScalarField pierced = [](const Vector3& p) { return p[0] > 0.495 ? kNotDefined : sphereField(p); };
  SurfaceMesh mesh = meshOf(pierced, 0.02, {{-0.5, 0, 0}});
  const std::size_t rim = meshTopology(mesh).open_edges;
  ASSERT_GT(rim, 0u);
  EXPECT_EQ(fillSmallHoles(mesh, rim - 1), 0u);
  EXPECT_EQ(fillSmallHoles(mesh, rim), 1u);
  expectClosed(mesh, 2);
  ASSERT_EQ(mesh.normals.size(), mesh.vertexCount());
  EXPECT_GT(mesh.normals.x[mesh.vertexCount() - 1], 0.99f);
  EXPECT_EQ(fillSmallHoles(mesh, 1000), 0u);

  const ScalarField cap = [](const Vector3& p) { return p[0] < 0.45 ? kNotDefined : sphereField(p); };
  SurfaceMesh patch = meshOf(cap, 0.02, {{0.5, 0, 0}});
  ASSERT_GT(patch.triangleCount(), 100u);
  EXPECT_EQ(fillSmallHoles(patch, 1000), 0u);
}

TEST(SurfaceMesh, topologyCountsBorderAndBadEdges)
{
  SurfaceMesh mesh;
  mesh.vertices = SoaBuffer(5);
  mesh.triangles = {0, 1, 2, 2, 1, 3};
  EXPECT_EQ(meshTopology(mesh).open_edges, 4u);
  EXPECT_EQ(meshTopology(mesh).inconsistent_edges, 0u);
  EXPECT_EQ(meshTopology(mesh).euler_characteristic, 1);
  mesh.triangles = {0, 1, 2, 1, 2, 3};
  EXPECT_EQ(meshTopology(mesh).inconsistent_edges, 1u);
  mesh.triangles = {0, 1, 2, 2, 1, 3, 2, 1, 4};
  EXPECT_EQ(meshTopology(mesh).inconsistent_edges, 1u);
  EXPECT_EQ(meshTopology(SurfaceMesh()).components, 0u);
}

} // namespace
} // namespace pcl_gpf::test
