// SPDX-License-Identifier: BSD-3-Clause
#include "support/implicit_shapes.h"
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/surface/poisson_mesh.h>

#include <gtest/gtest.h>

namespace pcl_gpf::test {
namespace {

PoissonMeshParameters
depth(unsigned levels)
{
  PoissonMeshParameters p;
  p.depth = levels;
  return p;
}

TEST(PoissonMesh, isAClosedSphereThatLooksOutward)
{
  const LocalCloud cloud = toLocalCloud(turned(sphere(5000)));
  const SurfaceMesh mesh = meshPoisson(depth(6), cloud.points.view(), cloud.normals.view());
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_EQ(topology.open_edges, 0u);
  EXPECT_EQ(topology.inconsistent_edges, 0u);
  EXPECT_EQ(topology.euler_characteristic, 2);
  const double radius = 0.5 / std::sqrt(3.0); // the box diagonal is 1
  for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vector3 p = {mesh.vertices.x[v], mesh.vertices.y[v], mesh.vertices.z[v]};
    ASSERT_NEAR(distance(p, {0, 0, 0}), radius, 0.03 * radius);
    ASSERT_GT(p[0] * mesh.normals.x[v] + p[1] * mesh.normals.y[v] + p[2] * mesh.normals.z[v], 0.0);
  }
}

TEST(PoissonMesh, trimsWhatLiesFarFromThePoints)
{
  const LocalCloud cloud = toLocalCloud(turned(plane(5000)));
  PoissonMeshParameters whole = depth(6), trimmed = depth(6);
  whole.trim = 0;
  trimmed.trim = 3;
  EXPECT_LT(meshPoisson(trimmed, cloud.points.view(), cloud.normals.view()).triangleCount(),
            meshPoisson(whole, cloud.points.view(), cloud.normals.view()).triangleCount());
}

TEST(PoissonMesh, refusesWhatMakesNoSurface)
{
  for (const std::size_t size : {0u, 1u, 3u, 20u}) {
    const SoaBuffer points = toBuffer(std::vector<Vector3>(size, {0.1, 0.1, 0.1})), normals = toBuffer(std::vector<Vector3>(size, {0, 0, 1}));
    EXPECT_THROW(meshPoisson({}, points.view(), normals.view()), UnsuitableData);
  }
  EXPECT_THROW(validate(depth(1)), InvalidParameter);
  EXPECT_THROW(validate(depth(13)), InvalidParameter);
}

} // namespace
} // namespace pcl_gpf::test
