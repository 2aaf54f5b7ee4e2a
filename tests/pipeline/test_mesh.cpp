// SPDX-License-Identifier: BSD-3-Clause
#include "support/implicit_shapes.h"
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/pipeline/mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_gpf::test {
namespace {

/** A shape in double coordinates far from the origin. */
struct Cloud {
  explicit Cloud(const Shape& shape, const Vector3& offset = {691000, 5335000, 500}) : shift(offset)
  {
    for (std::size_t i = 0; i < shape.size(); ++i) {
      x.push_back(shape.points[i][0] + offset[0]);
      y.push_back(shape.points[i][1] + offset[1]);
      z.push_back(shape.points[i][2] + offset[2]);
      nx.push_back(static_cast<float>(shape.normals[i][0]));
      ny.push_back(static_cast<float>(shape.normals[i][1]));
      nz.push_back(static_cast<float>(shape.normals[i][2]));
    }
  }
  DenoiseInput input() const { return {x.data(), y.data(), z.data(), x.size(), nx.data(), ny.data(), nz.data()}; }
  void
  flip(std::size_t i)
  {
    nx[i] = -nx[i];
    ny[i] = -ny[i];
    nz[i] = -nz[i];
  }

  Vector3 shift;
  std::vector<double> x, y, z;
  std::vector<float> nx, ny, nz;
};

MeshParameters
atResolution(unsigned resolution)
{
  MeshParameters parameters;
  parameters.rimls.resolution = resolution;
  return parameters;
}

/** Radii about the centre, and how far normals are from the direction away from it. */
void
expectSphere(const Cloud& cloud, const MeshResult& mesh, double radius)
{
  ASSERT_GT(mesh.vertices.size(), 3000u);
  EXPECT_EQ(mesh.open_edges, 0u);
  EXPECT_EQ(mesh.components, 1u);
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 3) {
    const Vector3 p = {mesh.vertices[v] - cloud.shift[0], mesh.vertices[v + 1] - cloud.shift[1], mesh.vertices[v + 2] - cloud.shift[2]};
    ASSERT_NEAR(distance(p, {0, 0, 0}), radius, 0.02 * radius);
    ASSERT_LT(distance({mesh.normals[v], mesh.normals[v + 1], mesh.normals[v + 2]}, {p[0] / radius, p[1] / radius, p[2] / radius}), 0.1);
    const std::size_t row = mesh.source_rows[v / 3];
    ASSERT_LT(distance({cloud.x[row], cloud.y[row], cloud.z[row]}, {mesh.vertices[v], mesh.vertices[v + 1], mesh.vertices[v + 2]}), 0.1);
  }
}

TEST(MeshCloud, keepsTheFrameOfTheInputAndNamesTheRows)
{
  Cloud cloud(sphere(5000));
  cloud.x[17] = std::numeric_limits<double>::quiet_NaN();
  cloud.nx[18] = cloud.ny[18] = cloud.nz[18] = 0;
  const MeshResult mesh = meshCloud(cloud.input(), atResolution(40));
  expectSphere(cloud, mesh, 0.5);
  EXPECT_EQ(mesh.points, 4998u);
  EXPECT_EQ(mesh.non_finite_points, 1u);
  EXPECT_EQ(mesh.points_without_normal, 1u);
  EXPECT_FALSE(mesh.oriented);
  EXPECT_NEAR(mesh.rimls.cell_size, 1.0 / 40, 0.002);
}

TEST(MeshCloud, orientsNormalsThatContradictEachOther)
{
  Cloud cloud(sphere(5000));
  for (std::size_t i = 0; i < 5000; i += 3)
    cloud.flip(i);
  const MeshResult mesh = meshCloud(cloud.input(), atResolution(40));
  expectSphere(cloud, mesh, 0.5);
  EXPECT_TRUE(mesh.oriented);
  EXPECT_NEAR(mesh.inconsistent_normals, 1.0 / 3, 0.01);
  EXPECT_EQ(mesh.orientation.flipped, 1667u);

  MeshParameters keep = atResolution(40);
  keep.orientation = MeshOrientation::Keep;
  const MeshResult broken = meshCloud(cloud.input(), keep);
  EXPECT_FALSE(broken.oriented);
  EXPECT_TRUE(broken.open_edges > 0 || broken.components != 1);
}

TEST(MeshCloud, poissonMakesTheSameSphere)
{
  const Cloud cloud(sphere(5000));
  MeshParameters parameters;
  parameters.method = MeshMethod::Poisson;
  parameters.poisson.depth = 6;
  expectSphere(cloud, meshCloud(cloud.input(), parameters), 0.5);
}

TEST(MeshCloud, tellsStagesAndCanBeCancelledInEach)
{
  Cloud cloud(sphere(3000));
  MeshParameters parameters = atResolution(30);
  parameters.orientation = MeshOrientation::Orient;
  std::vector<std::string> stages;
  meshCloud(cloud.input(), parameters, nullptr, [&](const std::string& stage, double) {
    if (stages.empty() || stages.back() != stage)
      stages.push_back(stage);
    return true;
  });
  EXPECT_EQ(stages, (std::vector<std::string>{"orient", "mesh"}));
  for (const char* stop : {"orient", "mesh"})
    EXPECT_THROW(meshCloud(cloud.input(), parameters, nullptr, [&](const std::string& stage, double) { return stage != stop; }), Cancelled);
  parameters.method = MeshMethod::Poisson;
  EXPECT_THROW(meshCloud(cloud.input(), parameters, nullptr, [](const std::string& stage, double) { return stage != "mesh"; }), Cancelled);
}

TEST(MeshCloud, refusesWhatMakesNoMesh)
{
  const Cloud few(sphere(3)), none(Shape{});
  EXPECT_THROW(meshCloud(few.input(), {}), UnsuitableData);
  EXPECT_THROW(meshCloud(none.input(), {}), UnsuitableData);
  const Cloud cloud(sphere(1000));
  DenoiseInput without = cloud.input();
  without.normal_x = without.normal_y = without.normal_z = nullptr;
  EXPECT_THROW(meshCloud(without, {}), InvalidParameter);
  EXPECT_THROW(meshCloud(cloud.input(), atResolution(1)), InvalidParameter);
  EXPECT_THROW(meshCloud(cloud.input(), atResolution(60000)), ExcessiveWork);
}

} // namespace
} // namespace pcl_gpf::test
