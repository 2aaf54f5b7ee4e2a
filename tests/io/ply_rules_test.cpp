// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the strict PLY reader, with files that break it and odd files that do not.
#include <cmath>

#include "io/rule_case.h"

namespace pcl_gpf::test {
namespace {

const std::string kVertex = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kAscii = "ply\nformat ascii 1.0\n" + kVertex + "end_header\n1 2 3\n4 5 6\n";
const std::string kBinary =
    "ply\nformat binary_little_endian 1.0\n" + kVertex + "end_header\n" + std::string(24, '\x3f');

/** A text file with more in the header and the body. */
std::string with(const std::string& header, const std::string& rows) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + rows;
}

TEST(PlyRules, Header) {
  std::string many_properties = kVertex;
  for (int i = 3; i < 1001; ++i)
    many_properties += "property uchar p" + std::to_string(i) + "\n";
  std::string many_elements = kVertex;
  for (int i = 1; i < 10001; ++i)
    many_elements += "element e" + std::to_string(i) + " 0\n";
  const RuleCase cases[] = {
      {"good", kAscii, 2, ""},
      {"format twice", changed(kAscii, "element", "format ascii 1.0\nelement"), kRefused, "a second one"},
      {"format unknown", changed(kAscii, "ascii", "text"), kRefused, "'text'"},
      {"format without version", changed(kAscii, " 1.0", ""), kRefused, "line 2"},
      {"version 1.1", changed(kAscii, "1.0", "1.1"), kRefused, "'1.1'"},
      {"format after the elements",
       changed(changed(kAscii, "format ascii 1.0\n", ""), "end_header", "format ascii 1.0\nend_header"), 2, ""},
      {"unknown keyword", changed(kAscii, "element", "vertices 2\nelement"), kRefused, "'vertices 2'"},
      {"end_header with a tail", changed(kAscii, "end_header", "end_header now"), kRefused, "end_header now"},
      {"no end_header", changed(kAscii, "end_header\n", ""), kRefused, "line 7"},
      {"element without a count", changed(kAscii, "vertex 2", "vertex"), kRefused, "NAME COUNT"},
      {"element with two counts", changed(kAscii, "vertex 2", "vertex 2 2"), kRefused, "NAME COUNT"},
      {"count -2", changed(kAscii, "vertex 2", "vertex -2"), kRefused, "'-2'"},
      {"count 2^31", changed(kAscii, "vertex 2", "vertex 2147483648"), kRefused, "2147483648"},
      {"count 2^64 + 2", changed(kAscii, "vertex 2", "vertex 18446744073709551618"), kRefused, "line 3"},
      {"element twice", with(kVertex + "element vertex 0\n", "1 2 3\n4 5 6\n"), kRefused, "'vertex' twice"},
      {"Vertex with a capital", changed(kAscii, "vertex", "Vertex"), kRefused, "element vertex"},
      {"type unknown", changed(kAscii, "float x", "real x"), kRefused, "'real'"},
      {"64-bit integer, which PLY lacks", changed(kAscii, "float x", "int64 x"), kRefused, "'int64'"},
      {"property without a name", changed(kAscii, "float x", "float"), kRefused, "line 4"},
      {"property with two names", changed(kAscii, "float x", "float x x"), kRefused, "line 4"},
      {"list with a float length", changed(kAscii, "float z", "float z\nproperty list float int a"), kRefused,
       "'float'"},
      {"list without a name", changed(kAscii, "float z", "float z\nproperty list uchar int"), kRefused, "line 7"},
      {"x is a list", changed(kAscii, "float x", "list uchar float x"), kRefused, ""},
      {"no y", with("element vertex 1\nproperty float x\nproperty float z\n", "1 2\n"), kRefused, "field y"},
      {"sized type names", changed(changed(kAscii, "float x", "float64 x"), "float y", "int32 y"), 2, ""},
      {"NUL in the header", changed(kAscii, "float x", std::string("float\0x", 7)), kRefused, "NUL"},
      {"1001 properties", with(many_properties, ""), kRefused, "1000"},
      {"10001 elements", with(many_elements, ""), kRefused, "10000"},
      {"header beyond 1 MiB", changed(kAscii, "element", "comment " + std::string(1 << 20, 'c') + "\nelement"),
       kRefused, "1 MiB"},
      {"CR LF", withLineEnds(kAscii, "\r\n"), 2, ""},
      {"CR alone", withLineEnds(kAscii, "\r"), 2, "CR"},
      {"byte-order mark", "\xef\xbb\xbf" + kAscii, 2, "byte-order"},
      {"PLY in capitals", changed(kAscii, "ply", "PLY"), kRefused, "expected a PCD or PLY header"},
      {"ply with a tail", changed(kAscii, "ply", "plyx"), kRefused, "expected a PCD or PLY header"},
      {"comments and obj_info", changed(kAscii, "element", "comment\ncomment a\nobj_info\nobj_info num_cols\nelement"),
       2, ""}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.ply");
}

TEST(PlyRules, Promises) {
  const RuleCase cases[] = {
      {"binary, one byte short", kBinary.substr(0, kBinary.size() - 1), kRefused, "bytes"},
      {"binary, one byte more", kBinary + "!", 2, "1 bytes after"},
      {"big endian is as long", changed(kBinary, "little", "big"), 2, ""},
      {"text, too short for the rows", changed(kAscii, "vertex 2", "vertex 5"), kRefused, "at least 5 bytes"},
      {"text, a row missing", changed(kAscii, "4 5 6", "      "), kRefused, "another row"},
      {"entries without properties", with(kVertex + "element ghost 3\n", "1 2 3\n4 5 6\n"), kRefused, "'ghost'"},
      {"no entries without properties", with(kVertex + "element ghost 0\n", "1 2 3\n4 5 6\n"), 2, ""},
      {"second element does not fit beside the first",
       changed(kBinary, "end_header", "element more 7\nproperty uchar a\nend_header"), kRefused, "7 rows"},
      {"sum of the elements does not fit",
       changed(changed(kBinary, "vertex 2", "vertex 1"), "end_header", "element more 13\nproperty uchar a\nend_header"),
       kRefused, "13 rows"},
      {"sum of the elements fits exactly",
       changed(changed(kBinary, "vertex 2", "vertex 1"), "end_header", "element more 12\nproperty uchar a\nend_header"),
       1, ""}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.ply");
}

TEST(PlyRules, Rows) {
  const std::string face = kVertex + "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string points = "1 2 3\n4 5 6\n";
  const RuleCase cases[] = {
      {"value missing", changed(kAscii, "1 2 3", "1 2"), kRefused, "line 8"},
      {"value too many", changed(kAscii, "1 2 3", "1 2 3 4"), kRefused, "line 8"},
      {"word", changed(kAscii, "4 5 6", "4 five 6"), kRefused, "'five'"},
      {"300 as uchar", with(kVertex + "property uchar a\n", "1 2 3 4\n1 2 3 300\n"), kRefused, "'300'"},
      {"-1 as uint", with(kVertex + "property uint a\n", "1 2 3 4\n1 2 3 -1\n"), kRefused, "'-1'"},
      {"1.5 as int", with(kVertex + "property int a\n", "1 2 3 4\n1 2 3 1.5\n"), kRefused, "'1.5'"},
      {"NUL between digits", changed(kAscii, "4 5 6", std::string("4 5\0 6", 6)), kRefused, "line 9"},
      {"blank line in the body", changed(kAscii, "4 5 6", "\n\n4 5 6"), 2, ""},
      {"text after the last row", kAscii + "7 8 9\n", 2, "after the last promised row"},
      {"faces are passed over", with(face, points + "3 0 1 1\n"), 2, ""},
      {"face shorter than it says", with(face, points + "3 0 1  \n"), kRefused, "line 12"},
      {"face longer than it says", with(face, points + "3 0 1 0 1\n"), kRefused, "line 12"},
      {"face length that the line cannot hold", with(face, points + "200 0 1\n"), kRefused, "list length"},
      {"face length -1", with(changed(face, "uchar", "char"), points + "-1 0 0\n"), kRefused, "-1"},
      {"word in a face", with(face, points + "3 0 1 b\n"), kRefused, "'b'"},
      {"element before vertex", with("element a 1\nproperty int b\n" + kVertex, "7\n" + points), 2, ""},
      {"camera of another kind", with(kVertex + "element camera 1\nproperty float view_px\n", points + "1\n"), 2, ""},
      {"camera of zeros",
       with(kVertex + "element camera 1\nproperty float view_px\nproperty float x_axisx\n", points + "0 0\n"), 2, ""}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.ply");
}

TEST(PlyRules, ListsOfVertices) {
  const std::string list =
      "element vertex 2\nproperty list uchar short a\nproperty float x\nproperty float y\nproperty float z\n";
  const CloudFile constant = readText(with(list, "2 7 8 1 2 3\n2 9 10 4 5 6\n"), "a.ply");
  ASSERT_EQ(constant.findField("a"), 0);
  EXPECT_EQ(constant.fields[0].count, 2U);
  EXPECT_EQ(constant.value(1, 0, 1), 10);
  EXPECT_EQ(constant.value(1, constant.findField("z")), 6);
  const CloudFile varying = readText(with(list, "2 7 8 1 2 3\n1 9 4 5 6\n"), "a.ply");
  EXPECT_EQ(varying.findField("a"), -1);
  EXPECT_EQ(varying.warnings.size(), 1U);
  EXPECT_EQ(varying.value(1, varying.findField("z")), 6);
  const CloudFile empty = readText(with(list, "0 1 2 3\n0 4 5 6\n"), "a.ply");
  EXPECT_EQ(empty.findField("a"), -1);
  EXPECT_EQ(empty.value(1, empty.findField("x")), 4);

  const std::string binary_list = "ply\nformat binary_big_endian 1.0\n" + changed(list, "uchar short", "ushort uchar");
  const std::string row(12, '\0');
  const std::string constant_rows = std::string("\0\1A", 3) + row + std::string("\0\1B", 3) + row;
  const CloudFile binary = readText(binary_list + "end_header\n" + constant_rows, "a.ply");
  EXPECT_EQ(binary.value(1, 0), 'B');
  const std::string varying_rows = std::string("\0\1A", 3) + row + std::string("\0\2BC", 4) + row;
  EXPECT_EQ(readText(binary_list + "end_header\n" + varying_rows, "a.ply").pointStep(), 12U);
  const std::string long_list = std::string("\0\1A", 3) + row +
                                std::string("\xff\xff"
                                            "C",
                                            3) +
                                row;
  EXPECT_THROW(readText(binary_list + "end_header\n" + long_list, "a.ply"), IoError);
}

TEST(PlyRules, BytesOrderAndTypesAreTheFilesOwn) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty uchar blue\nproperty short x\nproperty double y\n"
      "property char a\nproperty uint z\nend_header\n" +
      std::string("\x07\xff\xfe\x40\x09\x21\xfb\x54\x44\x2d\x18\x80\xff\xff\xff\xfe", 16);
  const CloudFile cloud = readText(text, "a.ply");
  EXPECT_EQ(cloud.value(0, cloud.findField("x")), -2);
  EXPECT_EQ(cloud.value(0, cloud.findField("y")), 3.141592653589793);
  EXPECT_EQ(cloud.value(0, cloud.findField("z")), 4294967294.0);
  EXPECT_EQ(cloud.value(0, cloud.findField("a")), -128);
  EXPECT_EQ(cloud.value(0, cloud.findField("blue")), 7);
}

TEST(PlyRules, ObjInfoOrganisesOnlyWhatItFits) {
  const auto grid = [](const char* columns, const char* rows) {
    return readText(changed(kAscii, "element",
                            std::string("obj_info num_cols ") + columns + "\nobj_info num_rows " + rows + "\nelement"),
                    "a.ply");
  };
  EXPECT_EQ(grid("1", "2").height, 2U);
  EXPECT_TRUE(grid("1", "2").comments.empty());
  for (const auto& [columns, rows] :
       {std::pair{"1", "1"}, {"0", "0"}, {"4294967295", "4294967295"}, {"-1", "-2"}, {"2", "0"}}) {
    const CloudFile cloud = grid(columns, rows);
    EXPECT_EQ(cloud.width, 2U);
    EXPECT_EQ(cloud.height, 1U);
    EXPECT_EQ(cloud.comments.size(), 2U);
  }
}

TEST(PlyRules, TheCameraOfPclGivesTheViewpoint) {
  std::string camera = kVertex + "element camera 1\n";
  for (const char* name : {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy",
                           "y_axisz", "z_axisx", "z_axisy", "z_axisz"})
    camera += std::string("property float ") + name + "\n";
  camera += "property int viewportx\nproperty int viewporty\n";
  const std::string points = "1 2 3\n4 5 6\n";
  // A quarter turn about z, and half turns, in which the trace is negative.
  const CloudFile quarter = readText(with(camera, points + "7 8 9 0 -1 0 1 0 0 0 0 1 2000 1\n"), "a.ply");
  EXPECT_EQ(quarter.size(), 2U);
  const double half = std::sqrt(0.5);
  const std::array<double, 7> expected{7, 8, 9, half, 0, 0, half};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(quarter.viewpoint[i], expected[i], 1e-12) << i;
  EXPECT_EQ(readText(with(camera, points + "0 0 0 1 0 0 0 -1 0 0 0 -1 2 1\n"), "a.ply").viewpoint[4], 1);
  EXPECT_EQ(readText(with(camera, points + "0 0 0 -1 0 0 0 1 0 0 0 -1 2 1\n"), "a.ply").viewpoint[5], 1);
  EXPECT_EQ(readText(with(camera, points + "0 0 0 -1 0 0 0 -1 0 0 0 1 2 1\n"), "a.ply").viewpoint[6], 1);
  EXPECT_EQ(readText(with(camera, points + "7 8 9 0 0 0 0 0 0 0 0 0 2 1\n"), "a.ply").viewpoint[0], 0) << "no rotation";
}

} // namespace
} // namespace pcl_gpf::test
