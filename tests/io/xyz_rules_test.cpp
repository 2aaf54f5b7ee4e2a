// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the XYZ text reader and of the choice between the formats.
#include "io/rule_case.h"

namespace pcl_gpf::test {
namespace {

TEST(XyzRules, Rows) {
  std::string wide;
  for (int i = 0; i < 1001; ++i)
    wide += "1 ";
  const RuleCase cases[] = {{"three columns", "1 2 3\n4 5 6\n", 2, ""},
                            {"no line end at the end", "1 2 3\n4 5 6", 2, ""},
                            {"tabs, blanks, blank lines, CR LF", "\r\n 1\t2  3 \r\n\r\n4 5 6\r\n", 2, ""},
                            {"CR alone", "1 2 3\r4 5 6\r", 2, "CR"},
                            {"mixed line ends", "1 2 3\r\n4 5 6\n", 2, "some lines end"},
                            {"byte-order mark",
                             "\xef\xbb\xbf"
                             "1 2 3\n",
                             1, "byte-order"},
                            {"comments", "# a\n//X Y Z\n1 2 3\n# in between\n4 5 6\n", 2, ""},
                            {"nan and inf", "nan nan nan\n1 inf 2\n", 2, ""},
                            {"number of points first", "2\n1 2 3\n4 5 6\n", 2, ""},
                            {"number of points wrong", "3\n1 2 3\n4 5 6\n", kRefused, "3 points"},
                            {"number of points twice", "2\n2\n1 2 3\n", kRefused, "three columns"},
                            {"nothing but a comment", "# a\n", kRefused, "no row"},
                            {"blanks only", " \n \n", kRefused, "no row"},
                            {"two columns", "1 2\n3 4\n", kRefused, "three columns"},
                            {"a word alone", "hello\n", kRefused, "'hello'"},
                            {"prose", "The quick brown fox\n", kRefused, "'The'"},
                            {"titles in the first row", "x y z\n1 2 3\n", kRefused, "'x'"},
                            {"shorter row", "1 2 3\n4 5\n", kRefused, "line 2"},
                            {"longer row", "1 2 3\n4 5 6 7\n", kRefused, "line 2"},
                            {"word", "1 2 3\n4 5 six\n", kRefused, "'six'"},
                            {"commas between", "1,2,3\n", kRefused, "commas"},
                            {"decimal commas", "1,5 2,5 3,5\n", kRefused, "commas"},
                            {"semicolons", "1;2;3\n", kRefused, "'1;2;3'"},
                            {"NUL", std::string("1 2 3\n4 5 \0\n", 12), kRefused, "line 2"},
                            {"hexadecimal", "1 2 0x3\n", kRefused, "'0x3'"},
                            {"1001 columns", wide + "\n", kRefused, "1000"}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.xyz");
}

std::string namesOf(const CloudFile& cloud) {
  std::string names;
  for (const CloudField& field : cloud.fields)
    names += field.name + ' ';
  return names;
}

TEST(XyzRules, Columns) {
  EXPECT_EQ(namesOf(readText("1 2 3\n", "a.xyz")), "x y z ");
  EXPECT_EQ(namesOf(readText("1 2 3 4 5\n", "a.txt")), "x y z c4 c5 ");
  EXPECT_EQ(namesOf(readText("1 2 3 0 0 1\n", "a.ASC")), "x y z normal_x normal_y normal_z ");
  EXPECT_TRUE(readText("1 2 3 0 0 1\n", "a.xyz").hasNormals());
  EXPECT_EQ(namesOf(readText("1 2 3 4 5 6 7\n", "a.pts")), "x y z c4 c5 c6 c7 ");
  EXPECT_EQ(namesOf(readText("# columns: y x z t\n1 2 3 4\n", "a.csv")), "y x z t ");
  EXPECT_EQ(namesOf(readText("# columns: x y z t\n1 2 3\n", "a.xyz")), "x y z ") << "another number of columns";
  EXPECT_EQ(namesOf(readText("# columns: x y x\n1 2 3\n", "a.xyz")), "x y z ") << "a name twice";
  EXPECT_EQ(namesOf(readText("# columns: a b c\n1 2 3\n", "a.xyz")), "x y z ") << "no coordinates";
}

TEST(XyzRules, ValuesAreDoubles) {
  const CloudFile cloud = readText("500000.123456789 4000000.987654321 1e-300\n", "a.xyz");
  EXPECT_EQ(cloud.value(0, 0), 500000.123456789);
  EXPECT_EQ(cloud.value(0, 1), 4000000.987654321);
  EXPECT_EQ(cloud.value(0, 2), 1e-300);
}

TEST(FormatChoice, ContentDecidesAndTheNameOnlyAllowsXyz) {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                          "z\nend_header\n1 2 3\n";
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n";
  for (const char* name : {"a.pcd", "a.ply", "a.xyz", "a", "a.jpg", "a.PLY"}) {
    EXPECT_EQ(readText(ply, name).format, CloudFormat::PlyAscii) << name;
    EXPECT_EQ(readText(pcd, name).format, CloudFormat::PcdAscii) << name;
  }
  for (const char* name : {"a.pcd", "a.ply", "a", ".xyz/a", "a.las"}) {
    EXPECT_THROW(readText("1 2 3\n", name), IoError) << name;
    EXPECT_THROW(readText("", name), IoError) << name;
  }
  EXPECT_THROW(readText("", "a.xyz"), IoError);
  EXPECT_THROW(readText("\x89PNG\r\n\x1a\n", "a.pcd"), IoError);
  EXPECT_THROW(readText(std::string(1000, '\0'), "a.ply"), IoError);
  EXPECT_THROW(readText(std::string(1000, '\r'), "a.pcd"), IoError);
  EXPECT_THROW(readText("\xef\xbb\xbf", "a.pcd"), IoError);
}

} // namespace
} // namespace pcl_gpf::test
