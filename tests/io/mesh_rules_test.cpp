// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the mesh readers (PLY, OFF, OBJ), with files that break it and odd files that do not.
#include <gtest/gtest.h>

#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/mesh_file.h"

namespace pcl_gpf {
namespace {

TriangleMesh readText(const std::string& bytes, const std::string& name) {
  return readMeshBuffer(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), name);
}

constexpr int kRefused = -1;

struct MeshCase {
  const char* what;
  std::string bytes;
  int triangles;
  const char* part; // of the error's message
};

void expectMesh(const MeshCase& mesh_case, const std::string& name) {
  SCOPED_TRACE(mesh_case.what);
  try {
    const TriangleMesh mesh = readText(mesh_case.bytes, name);
    EXPECT_EQ(static_cast<int>(mesh.triangleCount()), mesh_case.triangles);
    for (const std::uint32_t index : mesh.triangles)
      EXPECT_LT(index, mesh.vertexCount());
  } catch (const IoError& error) {
    EXPECT_EQ(mesh_case.triangles, kRefused) << error.what();
    EXPECT_NE(std::string(error.what()).find(mesh_case.part), std::string::npos) << error.what();
  }
}

const std::string kCorners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(MeshRules, Off) {
  const MeshCase cases[] = {
      {"triangle", "OFF\n4 1 0\n" + kCorners + "3 0 1 2\n", 1, ""},
      {"square", "OFF\n4 1 0\n" + kCorners + "4 0 1 2 3\n", 2, ""},
      {"counts on the first line", "OFF 4 1 0\n" + kCorners + "3 0 1 2\n", 1, ""},
      {"no number of edges", "OFF\n4 1\n" + kCorners + "3 0 1 2\n", 1, ""},
      {"comments and blank lines", "# a\nOFF # b\n\n4 1 0 # c\n" + kCorners + "# d\n3 0 1 2 # e\n", 1, ""},
      {"colour after a face", "OFF\n4 1 0\n" + kCorners + "3 0 1 2 255 0 0\n", 1, ""},
      {"COFF", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n", 1, ""},
      {"CR LF", "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n", 1, ""},
      {"4OFF", "4OFF\n4 1 0\n" + kCorners + "3 0 1 2\n", kRefused, "'4OFF'"},
      {"OFF BINARY", "OFF BINARY\n4 1 0\n" + kCorners, kRefused, "'BINARY'"},
      {"no counts", "OFF\n", kRefused, "end of the file"},
      {"four counts", "OFF\n4 1 0 0\n" + kCorners + "3 0 1 2\n", kRefused, "three counts"},
      {"count -4", "OFF\n-4 1 0\n" + kCorners + "3 0 1 2\n", kRefused, "'-4'"},
      {"count that the file cannot hold", "OFF\n4000000 1 0\n" + kCorners + "3 0 1 2\n", kRefused, "bytes"},
      {"faces that the file cannot hold", "OFF\n4 1000000 0\n" + kCorners + "3 0 1 2\n", kRefused, "bytes"},
      {"vertex missing", "OFF\n5 1 0\n" + kCorners + "3 0 1 2\n", kRefused, "end of the file"},
      {"vertex with two numbers", "OFF\n4 1 0\n0 0\n" + kCorners + "3 0 1 2\n", kRefused, "line 3"},
      {"vertex with a word", "OFF\n4 1 0\n0 0 a\n" + kCorners + "3 0 1 2\n", kRefused, "'a'"},
      {"vertex nan", "OFF\n4 1 0\n0 0 nan\n" + kCorners + "3 0 1 2\n", kRefused, "'nan'"},
      {"face of two", "OFF\n4 1 0\n" + kCorners + "2 0 1    \n", kRefused, "three corners"},
      {"face out of range", "OFF\n4 1 0\n" + kCorners + "3 0 1 4\n", kRefused, "'4'"},
      {"face cut", "OFF\n4 1 0\n" + kCorners + "4 0 1 2\n", kRefused, "line 7"},
      {"face -1", "OFF\n4 1 0\n" + kCorners + "3 0 1 -1\n", kRefused, "'-1'"},
      {"word after a face", "OFF\n4 1 0\n" + kCorners + "3 0 1 2 red\n", kRefused, "'red'"},
      {"no face", "OFF\n4 0 0\n" + kCorners, kRefused, "at least one face"}};
  for (const MeshCase& mesh_case : cases)
    expectMesh(mesh_case, "a.off");
}

TEST(MeshRules, Obj) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const MeshCase cases[] = {{"triangle", corners + "f 1 2 3\n", 1, ""},
                            {"pentagon", corners + "v 0 2 0\nf 1 2 3 4 5\n", 3, ""},
                            {"negative numbers", corners + "f -4 -3 -2\n", 1, ""},
                            {"textures and normals", corners + "vt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1\n", 1, ""},
                            {"faces before vertices", "f 1 2 3\n" + corners, 1, ""},
                            {"colours", "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n", 1, ""},
                            {"groups, materials, comments",
                             "mtllib a.mtl\no b\n" + corners + "g c\nusemtl d\ns off\n# e\nf 1 2 3 # f\n", 1, ""},
                            {"index 0", corners + "f 0 1 2\n", kRefused, "'0'"},
                            {"index beyond", corners + "f 1 2 5\n", kRefused, "line 5"},
                            {"index 2^40", corners + "f 1 2 1099511627776\n", kRefused, "line 5"},
                            {"negative beyond", corners + "f -1 -2 -5\n", kRefused, "'-5'"},
                            {"lowest 64-bit index", corners + "f -1 -2 -9223372036854775808\n", kRefused, "line 5"},
                            {"word as index", corners + "f a b c\n", kRefused, "'a'"},
                            {"face of two", corners + "f 1 2\n", kRefused, "three corners"},
                            {"vertex of two", "v 0 0\n" + corners + "f 1 2 3\n", kRefused, "three coordinates"},
                            {"vertex of eight", "v 0 0 0 0 0 0 0 0\nf 1 1 1\n", kRefused, "three coordinates"},
                            {"vertex inf", "v 0 0 inf\n" + corners + "f 1 2 3\n", kRefused, "'inf'"},
                            {"unknown statement", corners + "face 1 2 3\n", kRefused, "'face'"},
                            {"continued line", corners + "f 1 2 \\\n3\n", kRefused, "backslash"},
                            {"no face", corners, kRefused, "at least one face"},
                            {"prose", "Dear reader\n", kRefused, "'Dear'"},
                            {"empty", "", kRefused, "empty file"}};
  for (const MeshCase& mesh_case : cases)
    expectMesh(mesh_case, "a.obj");
  EXPECT_THROW(readText(corners + "f 1 2 3\n", "a.txt"), IoError) << "OBJ has no mark, so the name must say it";
}

TEST(MeshRules, Ply) {
  const std::string vertices =
      "element vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty uchar red\n";
  const std::string rows = "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n";
  const auto file = [&](const std::string& faces, const std::string& face_rows) {
    return "ply\nformat ascii 1.0\n" + vertices + faces + "end_header\n" + rows + face_rows;
  };
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const MeshCase cases[] = {
      {"triangle", file(faces, "3 0 1 2\n"), 1, ""},
      {"square", file(faces, "4 0 1 2 3\n"), 2, ""},
      {"vertex_index", file("element face 1\nproperty list uchar uint vertex_index\n", "3 0 1 2\n"), 1, ""},
      {"more properties", file(faces + "property uchar a\nproperty list uchar float b\n", "3 0 1 2 7 2 1 1\n"), 1, ""},
      {"no face element", file("", ""), kRefused, "at least one face"},
      {"no face", file("element face 0\nproperty list uchar int vertex_indices\n", ""), kRefused, "at least one face"},
      {"faces without a list", file("element face 1\nproperty int vertex_indices\n", "3\n"), kRefused,
       "vertex_indices"},
      {"face of two", file(faces, "2 0 1\n"), kRefused, "three corners"},
      {"out of range", file(faces, "3 0 1 4\n"), kRefused, "below 4"},
      {"negative", file(faces, "3 0 1 -1\n"), kRefused, "below 4"},
      {"half an index", file("element face 1\nproperty list uchar float vertex_indices\n", "3 0 1 0.5\n"), kRefused,
       "below 4"},
      {"face cut", file(faces, "3 0 1  \n"), kRefused, "end of the line"}};
  for (const MeshCase& mesh_case : cases)
    expectMesh(mesh_case, "a.ply");
}

TEST(MeshRules, VerticesAreDoublesAndPolygonsFans) {
  const TriangleMesh mesh = readText("OFF\n4 1 0\n500000.123456789 0 0\n1 0 0\n1 1 0\n0 1 0\n4 3 2 1 0\n", "a.off");
  EXPECT_EQ(mesh.vertices[0], 500000.123456789);
  EXPECT_EQ(mesh.triangles, (std::vector<std::uint32_t>{3, 2, 1, 3, 1, 0}));
}

TEST(MeshRules, SharedMeshesAreClosedSurfaces) {
  const std::string path = std::string(PCL_GPF_SHARED_DIR) + "/data/mesh_organic/bunny_closed.ply";
  TriangleMesh mesh;
  try {
    mesh = readMesh(path);
  } catch (const IoError&) {
    GTEST_SKIP() << "no " << path;
  }
  // A closed surface of genus 0: V - E + F = 2 with E = 3 F / 2.
  EXPECT_EQ(mesh.vertexCount(), 37706U);
  EXPECT_EQ(mesh.triangleCount(), 75408U);
  EXPECT_EQ(static_cast<int>(mesh.vertexCount()) - static_cast<int>(mesh.triangleCount()) / 2, 2);
}

} // namespace
} // namespace pcl_gpf
