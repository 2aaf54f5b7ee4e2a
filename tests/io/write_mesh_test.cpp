// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/write_mesh.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"
#include "test_clouds.h"

namespace pcl_gpf::test {
namespace {

MeshFile tetrahedron(double offset = 0) {
  MeshFile file;
  file.mesh.vertices = {offset, 0, 0, offset + 1, 0, 0, offset, 1, 0, offset, 0, 1};
  file.mesh.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return file;
}

class WriteMesh : public ::testing::Test {
protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  TemporaryFolder folder_;
};

TEST_F(WriteMesh, ReadsBackAsItWasWritten) {
  for (const bool as_double : {false, true}) {
    MeshFile file = tetrahedron(as_double ? 691234.123456 : 0.5);
    MeshWriteOptions options;
    options.double_coordinates = as_double;
    options.overwrite = true;
    writeMesh(file, path("a.ply"), options);
    const TriangleMesh read = readMesh(path("a.ply"));
    EXPECT_EQ(read.vertices, file.mesh.vertices);
    EXPECT_EQ(read.triangles, file.mesh.triangles);
  }
}

TEST_F(WriteMesh, NormalsAndColoursAreFieldsOfTheVertices) {
  MeshFile file = tetrahedron();
  for (std::size_t i = 0; i < 12; ++i) {
    file.normals.push_back(0.25f * static_cast<float>(i));
    file.colors.push_back(static_cast<std::uint8_t>(20 * i));
  }
  file.comments = {"made by a test"};
  writeMesh(file, path("a.ply"));
  const CloudFile cloud = readCloud(path("a.ply"));
  ASSERT_EQ(cloud.size(), 4u);
  ASSERT_TRUE(cloud.hasNormals());
  EXPECT_EQ(cloud.value(2, cloud.findField("normal_y")), 0.25 * 7);
  EXPECT_EQ(cloud.value(3, cloud.findField("blue")), 220);
  EXPECT_EQ(cloud.comments, std::vector<std::string>{"made by a test"});
}

TEST_F(WriteMesh, CoordinatesBeyondFloatAreWrittenAsDouble) {
  MeshFile file = tetrahedron();
  file.mesh.vertices[0] = -1e39;
  writeMesh(file, path("a.ply"), {});
  EXPECT_EQ(readMesh(path("a.ply")).vertices, file.mesh.vertices);
}

TEST_F(WriteMesh, AnEmptyMeshIsAFile) {
  writeMesh({}, path("a.ply"));
  EXPECT_EQ(readCloud(path("a.ply")).size(), 0u);
}

TEST_F(WriteMesh, RefusesWhatIsNoMeshAndWritesNothing) {
  const auto refused = [&](const auto& change) {
    MeshFile file = tetrahedron();
    change(file);
    EXPECT_THROW(writeMesh(file, path("a.ply")), std::invalid_argument);
  };
  refused([](MeshFile& file) { file.mesh.triangles[3] = 4; });
  refused([](MeshFile& file) { file.mesh.triangles.pop_back(); });
  refused([](MeshFile& file) { file.mesh.vertices.pop_back(); });
  refused([](MeshFile& file) { file.normals.resize(5); });
  refused([](MeshFile& file) { file.colors.resize(5); });
  refused([](MeshFile& file) { file.comments = {"two\nlines"}; });
  refused([](MeshFile& file) { file.mesh.vertices[0] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_FALSE(std::ifstream(path("a.ply")).good());
}

TEST_F(WriteMesh, RefusesPathsThatAreNoPlyFileOrCannotBeWritten) {
  EXPECT_THROW(writeMesh(tetrahedron(), path("a.obj")), IoError);
  EXPECT_THROW(writeMesh(tetrahedron(), path("a")), IoError);
  EXPECT_THROW(writeMesh(tetrahedron(), path("no_folder/a.ply")), IoError);
  writeMesh(tetrahedron(), path("a.PLY"));
  EXPECT_THROW(writeMesh(tetrahedron(), path("a.PLY")), IoError) << "exists";
  EXPECT_THROW(checkMeshWritable(path("a.PLY"), false), IoError);
  EXPECT_NO_THROW(checkMeshWritable(path("a.PLY"), true));
  EXPECT_NO_THROW(checkMeshWritable("-", false));
}

} // namespace
} // namespace pcl_gpf::test
