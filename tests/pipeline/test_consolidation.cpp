// SPDX-License-Identifier: BSD-3-Clause
// The class is consolidate() on PCL's clouds: same numbers, all other fields of the parents, PCL's manners.
#include "support/clouds.h"

#include <pcl_gpf/pipeline/consolidation.h>

#include <pcl/conversions.h>
#include <pcl/exceptions.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pcl_gpf::test {
namespace {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
noisySphere(std::size_t count = 1500)
{
  const auto cloud = toCloud<PointT>(sphere(count, 0.003));
  for (PointT& point : *cloud)
    point.normal_x = point.normal_y = point.normal_z = 0.0f; // to be estimated
  return cloud;
}

ConsolidationParameters
allStages()
{
  ConsolidationParameters p;
  p.upsample = true;
  p.meshing.rimls.resolution = 30;
  return p;
}

template <typename PointT>
ConsolidationResult
byFunction(const pcl::PointCloud<PointT>& cloud, const ConsolidationParameters& parameters)
{
  std::vector<double> x, y, z;
  for (const PointT& point : cloud) {
    x.push_back(static_cast<double>(point.x));
    y.push_back(static_cast<double>(point.y));
    z.push_back(static_cast<double>(point.z));
  }
  return consolidate({x.data(), y.data(), z.data(), x.size()}, parameters);
}

/** Point k of a result: the numbers of the function in float, everything else of the parent. */
template <typename PointT>
void
expectPoint(const PointT& point, const double* position, const float* normal, std::uint32_t row, int parent)
{
  ASSERT_EQ(parent, static_cast<int>(row));
  ASSERT_EQ(numberOf(point), parent) << "colour, intensity, curvature are those of one input point";
  ASSERT_EQ(point.x, static_cast<float>(position[0]));
  ASSERT_EQ(point.y, static_cast<float>(position[1]));
  ASSERT_EQ(point.z, static_cast<float>(position[2]));
  ASSERT_EQ(point.normal_x, normal[0]);
  ASSERT_EQ(point.normal_y, normal[1]);
  ASSERT_EQ(point.normal_z, normal[2]);
}

template <typename PointT>
class ConsolidationClass : public ::testing::Test {};

using PointTypes = ::testing::Types<pcl::PointNormal, pcl::PointXYZRGBNormal, pcl::PointXYZINormal>;
TYPED_TEST_SUITE(ConsolidationClass, PointTypes);

TYPED_TEST(ConsolidationClass, equalsTheFunctionAndKeepsTheFieldsOfParents)
{
  const auto cloud = noisySphere<TypeParam>();
  (*cloud)[7].y = kNaN;
  cloud->header.frame_id = "scanner";
  cloud->sensor_orientation_ = Eigen::Quaternionf(0, 1, 0, 0);
  Consolidation<TypeParam> consolidation;
  consolidation.setInputCloud(cloud);
  consolidation.setParameters(allStages());
  pcl::PointCloud<TypeParam> output, vertices;
  pcl::PolygonMesh mesh;
  consolidation.process(output, mesh);
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  const ConsolidationResult expected = byFunction(*cloud, allStages());

  ASSERT_EQ(output.size(), 2u * 1499u);
  EXPECT_EQ(output.height, 1u);
  EXPECT_TRUE(output.is_dense);
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_EQ(mesh.header.frame_id, "scanner");
  EXPECT_EQ(output.sensor_orientation_.x(), 1.0f);
  const ConsolidatedCloud& dense = expected.upsampled;
  ASSERT_EQ(dense.size(), output.size());
  ASSERT_EQ(consolidation.getCorrespondingIndices().size(), output.size());
  for (std::size_t i = 0; i < output.size(); ++i) {
    const double position[3] = {dense.x[i], dense.y[i], dense.z[i]};
    const float normal[3] = {dense.normal_x[i], dense.normal_y[i], dense.normal_z[i]};
    expectPoint(output[i], position, normal, dense.source_rows[i], consolidation.getCorrespondingIndices()[i]);
  }
  ASSERT_EQ(vertices.size(), expected.mesh.source_rows.size());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    expectPoint(vertices[v], &expected.mesh.vertices[3 * v], &expected.mesh.normals[3 * v], expected.mesh.source_rows[v],
                consolidation.getMeshCorrespondingIndices()[v]);
  ASSERT_EQ(3 * mesh.polygons.size(), expected.mesh.triangles.size());
  for (std::size_t corner = 0; corner < expected.mesh.triangles.size(); ++corner)
    ASSERT_EQ(mesh.polygons[corner / 3].vertices[corner % 3], static_cast<pcl::index_t>(expected.mesh.triangles[corner]));
  const ConsolidationStatistics& did = consolidation.getStatistics();
  EXPECT_EQ(did.input_points, 1499u);
  EXPECT_EQ(did.chain.denoise.scale.noise, expected.denoise.scale.noise);
  EXPECT_EQ(did.chain.mesh.open_edges, 0u);
  EXPECT_GT(did.chain.seconds.total, 0.0);
  EXPECT_TRUE(did.chain.mesh.vertices.empty() && did.chain.points.x.empty());
}

using Cloud = pcl::PointCloud<pcl::PointXYZINormal>;
using Class = Consolidation<pcl::PointXYZINormal>;

TEST(Consolidation, withoutAMeshAskedForThatStageDoesNotRunAndTheOutputMayBeTheInput)
{
  const Cloud::Ptr cloud = noisySphere<pcl::PointXYZINormal>(500);
  Class consolidation;
  consolidation.setInputCloud(cloud);
  double whole = 0.0;
  consolidation.setProgressCallback([&whole](const std::string& stage, double fraction) {
    EXPECT_NE(stage, "mesh");
    EXPECT_GE(fraction, whole);
    whole = fraction;
    return true;
  });
  Cloud output;
  consolidation.process(output);
  EXPECT_EQ(whole, 1.0);
  whole = 0.0;
  consolidation.process(*cloud);
  EXPECT_EQ(output.size(), 500u);
  EXPECT_TRUE(sameBits(*cloud, output));
}

TEST(Consolidation, indicesChooseTheData)
{
  const Cloud::Ptr cloud = noisySphere<pcl::PointXYZINormal>(600);
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 599; i > 200; --i)
    indices->push_back(i);
  indices->push_back(300); // twice
  Class consolidation;
  consolidation.setInputCloud(cloud);
  consolidation.setIndices(indices);
  Cloud output, expected;
  consolidation.process(output);
  ASSERT_EQ(output.size(), 399u);
  for (std::size_t i = 0; i < output.size(); ++i)
    ASSERT_EQ(numberOf(output[i]), 599 - static_cast<int>(i));
  indices->pop_back();
  const Cloud::Ptr part(new Cloud(*cloud, *indices));
  Class whole;
  whole.setInputCloud(part);
  whole.process(expected);
  EXPECT_TRUE(sameBits(output, expected));
  indices->push_back(600);
  EXPECT_THROW(consolidation.process(output), pcl::BadArgumentException);
  EXPECT_TRUE(output.empty());
}

TEST(Consolidation, partsFaceTheSensorWhereThereIsOne)
{
  const Cloud::Ptr cloud = toCloud<pcl::PointXYZINormal>(plane(500, 0.002));
  cloud->sensor_origin_ = Eigen::Vector4f(0, 0, -5, 0);
  Class consolidation;
  consolidation.setInputCloud(cloud);
  const auto side = [&] {
    Cloud output;
    consolidation.process(output);
    float sum = 0;
    for (const pcl::PointXYZINormal& point : output)
      sum += point.normal_z;
    return sum / static_cast<float>(output.size());
  };
  EXPECT_LT(side(), -0.9f);
  consolidation.setUseSensorOrigin(false);
  EXPECT_GT(side(), 0.9f);
  ConsolidationParameters p;
  p.viewpoint = {{0.0, 0.0, -3.0}};
  consolidation.setParameters(p);
  EXPECT_LT(side(), -0.9f);
}

TEST(Consolidation, cancelledInAnyStageItLeavesNothingStale)
{
  const Cloud::Ptr cloud = noisySphere<pcl::PointXYZINormal>(500);
  const Cloud before = *cloud;
  Class consolidation;
  consolidation.setInputCloud(cloud);
  consolidation.setParameters(allStages());
  Cloud output;
  pcl::PolygonMesh mesh;
  consolidation.process(output, mesh);
  const Cloud whole = output;
  const std::size_t triangles = mesh.polygons.size();
  for (const char* stage : {"normals", "bilateral", "filter", "orient", "upsampling", "mesh"}) {
    consolidation.setProgressCallback([stage](const std::string& name, double) { return name != stage; });
    consolidation.process(output, mesh);
    EXPECT_TRUE(output.empty() && mesh.polygons.empty() && mesh.cloud.data.empty()) << stage;
    EXPECT_TRUE(consolidation.getCorrespondingIndices().empty() && consolidation.getMeshCorrespondingIndices().empty());
    EXPECT_TRUE(consolidation.getStatistics().cancelled);
    consolidation.process(*cloud, mesh);
    EXPECT_TRUE(sameBits(*cloud, before)) << "the caller's own points are not thrown away";
  }
  consolidation.setProgressCallback({});
  consolidation.process(output, mesh);
  EXPECT_TRUE(sameBits(output, whole));
  EXPECT_EQ(mesh.polygons.size(), triangles);
  EXPECT_FALSE(consolidation.getStatistics().cancelled);
}

TEST(Consolidation, refusesBadInputAndEmptiesTheOutputs)
{
  Cloud output;
  pcl::PolygonMesh mesh;
  const auto run = [&](const Cloud& cloud, const ConsolidationParameters& parameters) {
    Class consolidation;
    consolidation.setInputCloud(cloud.makeShared());
    consolidation.setParameters(parameters);
    output = *noisySphere<pcl::PointXYZINormal>(10);
    mesh.polygons.resize(5);
    consolidation.process(output, mesh);
  };
  const auto refused = [&](const Cloud& cloud, const ConsolidationParameters& parameters, const std::string& figure) {
    std::string message;
    try {
      run(cloud, parameters);
    } catch (const pcl::ComputeFailedException& error) {
      message = error.what();
    } catch (const pcl::BadArgumentException& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(figure), std::string::npos) << "'" << message << "' names " << figure;
    EXPECT_TRUE(output.empty() && mesh.polygons.empty());
  };
  const Cloud good = *noisySphere<pcl::PointXYZINormal>(400);
  ConsolidationParameters fine = allStages(), few = allStages(), blind = allStages(), none = allStages();
  fine.meshing.rimls.resolution = 60000;
  few.upsampling.edge_aware.target_count = 100;
  blind.filter = blind.orient = blind.upsample = false;
  none.filter = none.orient = none.upsample = none.mesh = false;
  refused(good, fine, "GiB");
  refused(good, few, "400");
  refused(good, blind, "no normals");
  refused(good, none, "stage");
  refused(*noisySphere<pcl::PointXYZINormal>(2), allStages(), "2 finite points");
  Cloud same = good, line = good, nowhere = good;
  for (std::size_t i = 0; i < good.size(); ++i) {
    same[i].x = same[i].y = same[i].z = 1.0f;
    line[i].x = line[i].y = static_cast<float>(i);
    line[i].z = 3.0f;
    nowhere[i].z = kNaN;
  }
  refused(same, allStages(), "identical");
  refused(line, allStages(), "400 finite points lie on one line");
  refused(nowhere, allStages(), ""); // a warning
  refused(Cloud(), allStages(), "");

  Class unset;
  mesh.polygons.resize(5);
  output = good;
  unset.process(output, mesh);
  EXPECT_TRUE(output.empty() && mesh.polygons.empty());
}

} // namespace
} // namespace pcl_gpf::test
