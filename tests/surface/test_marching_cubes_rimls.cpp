// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/implicit_shapes.h"

#include <pcl_gpf/core/surface_mesh.h>
#include <pcl_gpf/surface/marching_cubes_rimls.h>

#include <pcl/conversions.h>
#include <pcl/exceptions.h>

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <string>

namespace pcl_gpf::test {
namespace {

template <typename PointT>
class MarchingCubesRIMLSTest : public ::testing::Test {};
using PointTypes = ::testing::Types<pcl::PointNormal, pcl::PointXYZRGBNormal, pcl::PointXYZINormal>;
TYPED_TEST_SUITE(MarchingCubesRIMLSTest, PointTypes);

MeshTopology
topologyOf(std::size_t vertices, const std::vector<pcl::Vertices>& polygons)
{
  SurfaceMesh mesh;
  mesh.vertices = SoaBuffer(vertices);
  for (const pcl::Vertices& polygon : polygons)
    for (const auto vertex : polygon.vertices)
      mesh.triangles.push_back(static_cast<std::uint32_t>(vertex));
  return meshTopology(mesh);
}

TYPED_TEST(MarchingCubesRIMLSTest, MakesAClosedMeshInCloudUnitsWithTheFieldsOfThePoints)
{
  using PointT = TypeParam;
  constexpr double kScale = 200;
  const auto cloud = toCloud<PointT>(sphere(5000), kScale, {1000, 2000, -500});
  cloud->header.frame_id = "scanner";
  pcl_gpf::MarchingCubesRIMLS<PointT> rimls;
  rimls.setInputCloud(cloud);
  rimls.setResolution(40);
  pcl::PointCloud<PointT> vertices;
  std::vector<pcl::Vertices> polygons;
  rimls.reconstruct(vertices, polygons);
  const MeshTopology topology = topologyOf(vertices.size(), polygons);
  EXPECT_EQ(topology.open_edges, 0u);
  EXPECT_EQ(topology.inconsistent_edges, 0u);
  EXPECT_EQ(topology.euler_characteristic, 2);
  EXPECT_EQ(vertices.header.frame_id, "scanner");
  EXPECT_TRUE(vertices.is_dense);
  ASSERT_EQ(rimls.getCorrespondingIndices().size(), vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector3 p = {vertices[v].x - 1000, vertices[v].y - 2000, vertices[v].z + 500};
    ASSERT_NEAR(distance(p, {0, 0, 0}), 0.5 * kScale, 0.02 * kScale);
    ASSERT_LT(distance(normal(vertices[v]), {2 * p[0] / kScale, 2 * p[1] / kScale, 2 * p[2] / kScale}), 0.1);
    const auto source = static_cast<std::size_t>(rimls.getCorrespondingIndices()[v]);
    ASSERT_EQ(numberOf(vertices[v]), static_cast<int>(source));
    ASSERT_LT(distance(position(vertices[v]), position((*cloud)[source])), 0.1 * kScale);
  }
  EXPECT_NEAR(rimls.getStatistics().mesh.cell_size, kScale / 40, 0.02 * kScale / 40);

  pcl::PolygonMesh mesh;
  rimls.reconstruct(mesh);
  EXPECT_EQ(mesh.polygons.size(), polygons.size());
  EXPECT_EQ(mesh.header.frame_id, "scanner");
  pcl::PointCloud<PointT> again;
  pcl::fromPCLPointCloud2(mesh.cloud, again);
  ASSERT_EQ(again.size(), vertices.size());
  EXPECT_TRUE(sameBits(again, vertices));
}

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Mesher = MarchingCubesRIMLS<pcl::PointNormal>;

std::size_t
facesOf(Mesher& mesher)
{
  pcl::PolygonMesh mesh;
  mesh.polygons.resize(5); // stale
  mesher.reconstruct(mesh);
  return mesh.polygons.size();
}

TEST(MarchingCubesRIMLS, HonoursIndicesAndLeavesOutWhatIsNotFinite)
{
  const Cloud::Ptr cloud = toCloud<pcl::PointNormal>(sphere(3000));
  const Shape other = sphere(3000, 0, 2);
  for (std::size_t i = 0; i < other.size(); ++i) {
    pcl::PointNormal point = (*toCloud<pcl::PointNormal>(Shape{{other.points[i]}, {other.normals[i]}}))[0];
    point.x += 3;
    cloud->push_back(point);
  }
  (*cloud)[7].x = kNaN;
  (*cloud)[8].normal_x = kNaN;
  Mesher mesher;
  mesher.setInputCloud(cloud);
  const pcl::IndicesPtr first(new pcl::Indices(3000));
  std::iota(first->begin(), first->end(), 0);
  mesher.setIndices(first);
  mesher.setResolution(30);
  Cloud vertices;
  std::vector<pcl::Vertices> polygons;
  mesher.reconstruct(vertices, polygons);
  EXPECT_EQ(topologyOf(vertices.size(), polygons).euler_characteristic, 2);
  for (const pcl::PointNormal& vertex : vertices)
    ASSERT_LT(vertex.x, 0.6f);
  EXPECT_EQ(mesher.getStatistics().points, 2998u);
  EXPECT_EQ(mesher.getStatistics().non_finite_points, 1u);
  EXPECT_EQ(mesher.getStatistics().points_without_normal, 1u);
}

TEST(MarchingCubesRIMLS, WithoutInputOrPointsTheMeshIsEmpty)
{
  Mesher mesher;
  EXPECT_EQ(facesOf(mesher), 0u);
  const Cloud::Ptr nan = toCloud<pcl::PointNormal>(sphere(20));
  for (pcl::PointNormal& point : *nan)
    point.x = kNaN;
  mesher.setInputCloud(nan);
  EXPECT_EQ(facesOf(mesher), 0u);
  mesher.setInputCloud(toCloud<pcl::PointNormal>(sphere(2000)));
  EXPECT_GT(facesOf(mesher), 0u) << "the object works afterwards";
}

TEST(MarchingCubesRIMLS, RefusesBeforeTheWorkAndSaysWhy)
{
  const auto message = [](Mesher& mesher) {
    pcl::PolygonMesh mesh;
    try {
      mesher.reconstruct(mesh);
    } catch (const pcl::PCLException& error) {
      EXPECT_TRUE(mesh.polygons.empty() && mesh.cloud.data.empty());
      return std::string(error.what());
    }
    return std::string();
  };
  Mesher mesher;
  Cloud::Ptr cloud = toCloud<pcl::PointNormal>(sphere(2000));
  mesher.setInputCloud(cloud);
  mesher.setResolution(60000);
  EXPECT_NE(message(mesher).find("GiB"), std::string::npos) << message(mesher);
  mesher.setGridResolution(0, 0, 0);
  EXPECT_NE(message(mesher).find("resolution"), std::string::npos);
  mesher.setGridResolution(20, 30, 10);
  EXPECT_EQ(mesher.getParameters().resolution, 30u);
  EXPECT_EQ(message(mesher), "");
  mesher.setIsoLevel(0.5f);
  EXPECT_NE(message(mesher).find("iso"), std::string::npos);
  mesher.setIsoLevel(0);
  for (std::size_t i = 0; i < cloud->size(); i += 2)
    (*cloud)[i].getNormalVector3fMap() *= -1;
  EXPECT_NE(message(mesher).find("orient"), std::string::npos) << message(mesher);
  mesher.setCheckOrientation(false);
  EXPECT_EQ(message(mesher), "");
  for (pcl::PointNormal& point : *cloud)
    point.normal_x = point.normal_y = point.normal_z = 0;
  EXPECT_NE(message(mesher).find("normal"), std::string::npos);
  mesher.setInputCloud(toCloud<pcl::PointNormal>(sphere(3)));
  EXPECT_NE(message(mesher).find("3 points"), std::string::npos);
}

TEST(MarchingCubesRIMLS, TheOutputMayBeTheInput)
{
  const auto cloud = toCloud<pcl::PointNormal>(sphere(2000));
  pcl_gpf::MarchingCubesRIMLS<pcl::PointNormal> rimls;
  rimls.setInputCloud(cloud);
  rimls.setResolution(20);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons, in_place;
  rimls.reconstruct(vertices, polygons);
  rimls.setScale(0);
  EXPECT_THROW(rimls.reconstruct(*cloud, in_place), pcl::BadArgumentException);
  EXPECT_EQ(cloud->size(), 2000u);
  rimls.setScale(6);
  rimls.reconstruct(*cloud, in_place);
  EXPECT_EQ(cloud->size(), vertices.size());
  EXPECT_EQ(in_place.size(), polygons.size());
}

TEST(MarchingCubesRIMLS, CanBeCancelled)
{
  Mesher mesher;
  mesher.setInputCloud(toCloud<pcl::PointNormal>(sphere(2000)));
  mesher.setProgressCallback([](double fraction) { return fraction < 0.3; });
  EXPECT_EQ(facesOf(mesher), 0u);
  EXPECT_TRUE(mesher.getStatistics().cancelled);
  mesher.setProgressCallback({});
  EXPECT_GT(facesOf(mesher), 0u);
  EXPECT_FALSE(mesher.getStatistics().cancelled);
}

TEST(MarchingCubesRIMLS, VerticesAtTheLimitOfFloatAreFinite)
{
  Mesher mesher;
  mesher.setInputCloud(toCloud<pcl::PointNormal>(sphere(1500), 1.9999 * static_cast<double>(std::numeric_limits<float>::max())));
  mesher.setResolution(20);
  Cloud vertices;
  std::vector<pcl::Vertices> polygons;
  mesher.reconstruct(vertices, polygons);
  ASSERT_FALSE(vertices.empty());
  for (const pcl::PointNormal& vertex : vertices)
    ASSERT_TRUE(pcl::isXYZFinite(vertex));
}

} // namespace
} // namespace pcl_gpf::test
