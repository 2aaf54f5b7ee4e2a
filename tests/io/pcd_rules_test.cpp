// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the strict PCD reader, with files that break it and odd files that do not.
#include <cmath>

#include "io/rule_case.h"

namespace pcl_gpf::test {
namespace {

const std::string kHeader =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
    "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
const std::string kAscii = kHeader + "DATA ascii\n1 2 3\n4 5 6\n";
const std::string kBinary = kHeader + "DATA binary\n" + std::string(24, '\x3f');
// Two sizes and one literal run of 24 bytes.
const std::string kCompressed =
    kHeader + "DATA binary_compressed\n" + std::string("\x19\0\0\0\x18\0\0\0\x17", 9) + std::string(24, '\x3f');

TEST(PcdRules, Header) {
  const RuleCase cases[] = {
      {"good ascii", kAscii, 2, ""},
      {"good binary", kBinary, 2, ""},
      {"unknown keyword", changed(kAscii, "HEIGHT", "DEPTH"), kRefused, "line 8"},
      {"lower-case keyword", changed(kAscii, "WIDTH", "width"), kRefused, "'width'"},
      {"SIZE twice", changed(kAscii, "TYPE", "SIZE 4 4 4\nTYPE"), kRefused, "SIZE again"},
      {"FIELDS and COLUMNS", changed(kAscii, "SIZE", "COLUMNS x y z\nSIZE"), kRefused, "FIELDS again"},
      {"COLUMNS alone, as old files have", changed(kAscii, "FIELDS", "COLUMNS"), 2, ""},
      {"no COUNT", changed(kAscii, "COUNT 1 1 1\n", ""), 2, ""},
      {"no SIZE", changed(kAscii, "SIZE 4 4 4\n", ""), kRefused, "SIZE"},
      {"no FIELDS", changed(kAscii, "FIELDS x y z\n", ""), kRefused, "FIELDS"},
      {"no POINTS", changed(kAscii, "POINTS 2\n", ""), 2, ""},
      {"no WIDTH", changed(kAscii, "WIDTH 2\n", ""), 2, ""},
      {"neither WIDTH nor POINTS", changed(changed(kAscii, "WIDTH 2\n", ""), "POINTS 2\n", ""), kRefused, "neither"},
      {"HEIGHT 2 without WIDTH", changed(changed(kAscii, "WIDTH 2\n", ""), "HEIGHT 1", "HEIGHT 2"), kRefused, "WIDTH"},
      {"two values for WIDTH", changed(kAscii, "WIDTH 2", "WIDTH 2 2"), kRefused, "line 7"},
      {"POINTS with a plus", changed(kAscii, "POINTS 2", "POINTS +2"), kRefused, "'+2'"},
      {"POINTS with a point", changed(kAscii, "POINTS 2", "POINTS 2.0"), kRefused, "'2.0'"},
      {"POINTS above 2^31 - 1", changed(kAscii, "POINTS 2", "POINTS 2147483648"), kRefused, "2147483647"},
      {"WIDTH x HEIGHT beyond 64 bits never happens, beyond 2^31 does",
       changed(changed(kAscii, "WIDTH 2\nHEIGHT 1", "WIDTH 2147483647\nHEIGHT 2147483647"), "POINTS 2\n", ""), kRefused,
       "2^31"},
      {"VIEWPOINT with a word", changed(kAscii, "1 0 0 0", "1 0 0 zero"), kRefused, "VIEWPOINT"},
      {"VIEWPOINT with eight numbers", changed(kAscii, "1 0 0 0", "1 0 0 0 0"), kRefused, "VIEWPOINT"},
      {"version of the future", changed(kAscii, "VERSION 0.7", "VERSION 0.8"), 2, "version 0.8"},
      {"version .7", changed(kAscii, "VERSION 0.7", "VERSION .7"), 2, ""},
      {"a word as version", changed(kAscii, "VERSION 0.7", "VERSION seven"), kRefused, "'seven'"},
      {"NUL in the header", changed(kAscii, "TYPE F", std::string("TYPE\0F", 6)), kRefused, "NUL"},
      {"unknown DATA", changed(kAscii, "DATA ascii", "DATA zip"), kRefused, "'zip'"},
      {"DATA in upper case", changed(kAscii, "DATA ascii", "DATA ASCII"), kRefused, "'ASCII'"},
      {"blank lines and comments between", changed(kAscii, "SIZE", "\n  \n# a comment\nSIZE"), 2, ""},
      {"blanks before a keyword", changed(kAscii, "SIZE", " \tSIZE"), 2, ""},
      {"comment beyond 1 MiB", "# " + std::string(1 << 20, 'c') + "\n" + kAscii, kRefused, ""},
      {"header beyond 1 MiB after its start", changed(kAscii, "SIZE", "#" + std::string(1 << 20, 'c') + "\nSIZE"),
       kRefused, "1 MiB"},
      {"CR LF", withLineEnds(kAscii, "\r\n"), 2, ""},
      {"CR alone", withLineEnds(kAscii, "\r"), 2, "CR"},
      {"mixed line ends", changed(kAscii, "SIZE 4 4 4\n", "SIZE 4 4 4\r\n"), 2, "some lines end"},
      {"byte-order mark", "\xef\xbb\xbf" + kAscii, 2, "byte-order"},
      {"entries in another order", "WIDTH 2\nTYPE F F F\nFIELDS x y z\nSIZE 4 4 4\nDATA ascii\n1 2 3\n4 5 6\n", 2, ""}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.pcd");
}

std::string withFields(const std::string& fields, const std::string& sizes, const std::string& types,
                       const std::string& counts, const std::string& rows) {
  return "VERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types + "\nCOUNT " + counts +
         "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n" + rows;
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i)
    result += text;
  return result;
}

TEST(PcdRules, Fields) {
  std::string names = "x y z";
  for (int i = 3; i < 1001; ++i)
    names += " f" + std::to_string(i);
  const RuleCase cases[] = {
      {"padding in text", withFields("x _ y z", "4 1 4 4", "F U F F", "1 2 1 1", "1 0 0 2 3\n"), 1, ""},
      {"two paddings", withFields("x _ y _ z", "4 1 4 1 4", "F U F U F", "1 1 1 1 1", "1 0 2 0 3\n"), 1, ""},
      {"a padding only", withFields("_", "4", "F", "1", "1\n"), kRefused, "field x"},
      {"no z", withFields("x y", "4 4", "F F", "1 1", "1 2\n"), kRefused, "field z"},
      {"one field xyz with COUNT 3", withFields("xyz", "4", "F", "3", "1 2 3\n"), kRefused, "field x"},
      {"COUNT 2 for x", withFields("x y z", "4 4 4", "F F F", "2 1 1", "1 1 2 3\n"), kRefused,
       "one element in field x"},
      {"F with SIZE 2", withFields("x y z", "2 4 4", "F F F", "1 1 1", "1 2 3\n"), kRefused, "SIZE '2'"},
      {"F with SIZE 1", withFields("x y z a", "4 4 4 1", "F F F F", "1 1 1 1", "1 2 3 4\n"), kRefused, "SIZE '1'"},
      {"SIZE 16", withFields("x y z a", "4 4 4 16", "F F F F", "1 1 1 1", "1 2 3 4\n"), kRefused, "'16'"},
      {"SIZE 04", withFields("x y z", "04 4 4", "F F F", "1 1 1", "1 2 3\n"), kRefused, "'04'"},
      {"lower-case TYPE", withFields("x y z", "4 4 4", "f F F", "1 1 1", "1 2 3\n"), kRefused, "TYPE 'f'"},
      {"more SIZE than FIELDS", withFields("x y z", "4 4 4 4", "F F F", "1 1 1", "1 2 3\n"), kRefused, "SIZE"},
      {"fewer COUNT than FIELDS", withFields("x y z", "4 4 4", "F F F", "1 1", "1 2 3\n"), kRefused, "COUNT"},
      {"name twice", withFields("x y z a a", "4 4 4 4 4", "F F F F F", "1 1 1 1 1", "1 2 3 4 5\n"), kRefused,
       "'a' twice"},
      {"x in upper case beside x", withFields("x y z X", "4 4 4 4", "F F F F", "1 1 1 1", "1 2 3 4\n"), 1, ""},
      {"1001 fields", withFields(names, repeated("4 ", 1001), repeated("F ", 1001), repeated("1 ", 1001), ""), kRefused,
       "1000"},
      {"row beyond 2 GiB", withFields("x y z a", "4 4 4 8", "F F F U", "1 1 1 300000000", "1 2 3\n"), kRefused,
       "2 GiB"},
      {"COUNT that the file cannot hold", withFields("x y z a", "4 4 4 1", "F F F U", "1 1 1 100000", "1 2 3\n"),
       kRefused, "bytes"},
      {"every type",
       withFields("x y z a b c d e f g", "1 2 4 8 1 2 4 8 4 8", "I I I I U U U U F F", repeated("1 ", 10),
                  "-128 -32768 -2147483648 -9223372036854775808 255 65535 4294967295 18446744073709551615 "
                  "1e38 1e308\n"),
       1, ""}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.pcd");
}

TEST(PcdRules, Text) {
  const auto rows = [](const std::string& text) { return kHeader + "DATA ascii\n" + text; };
  const RuleCase cases[] = {
      {"value missing", rows("1 2 3\n4 5\n"), kRefused, "line 13"},
      {"value too many", rows("1 2 3 4\n4 5 6\n"), kRefused, "line 12"},
      {"one row on two lines", rows("1 2\n3\n4 5 6\n"), kRefused, "line 12"},
      {"a row missing", rows("1 2 3\n      \n"), kRefused, "2 points"},
      {"too short at all", rows("1 2 3\n"), kRefused, "at least 5 bytes"},
      {"word", rows("1 2 3\n4 five 6\n"), kRefused, "'five'"},
      {"number with a tail", rows("1 2 3\n4 5m 6\n"), kRefused, "'5m'"},
      {"hexadecimal", rows("1 2 0x3\n4 5 6\n"), kRefused, "'0x3'"},
      {"two signs", rows("1 2 +-3\n4 5 6\n"), kRefused, "'+-3'"},
      {"a sign only", rows("1 2 -\n4 5 6\n"), kRefused, "'-'"},
      {"separated by commas", rows("1,2,3\n4,5,6\n"), kRefused, "'1,2,3'"},
      {"comment in the body", rows("# 1 2\n1 2 3\n4 5 6\n"), kRefused, "line 12"},
      {"blank lines in the body", rows("\n1 2 3\n\n  \n4 5 6\n\n"), 2, ""},
      {"plus, exponent, point at either end", rows("+1 2.e0 .3\n-4E+0 5 6\n"), 2, ""},
      {"inf, nan, -nan, INFINITY", rows("inf nan -nan\nINFINITY -inf 6\n"), 2, ""},
      {"beyond the type's range", rows("1e99 -1e99 1e-99\n4 5 6\n"), 2, ""},
      {"no line end at the end", rows("1 2 3\n4 5 6"), 2, ""},
      {"text after the last row", rows("1 2 3\n4 5 6\n7 8 9\n"), 2, "after the last promised row"}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.pcd");
}

TEST(PcdRules, NumbersOutsideTheTypeBecomeInfiniteOrZeroForRealsAndErrorsForIntegers) {
  const CloudFile cloud = readText(kHeader + "DATA ascii\n1e99 -1e99 -1e-99\n3.5e38 1e-46 0.0e999999999999\n", "a.pcd");
  EXPECT_EQ(cloud.value(0, 0), HUGE_VAL);
  EXPECT_EQ(cloud.value(0, 1), -HUGE_VAL);
  EXPECT_EQ(cloud.value(0, 2), 0.0);
  EXPECT_EQ(cloud.value(1, 0), HUGE_VAL);
  EXPECT_EQ(cloud.value(1, 1), 0.0);
  EXPECT_EQ(cloud.value(1, 2), 0.0);
  for (const char* value : {"256", "-1", "1.0", "1e2", "nan"})
    EXPECT_THROW(
        readText(withFields("x y z a", "4 4 4 1", "F F F U", "1 1 1 1", std::string("1 2 3 ") + value), "a.pcd"),
        IoError)
        << value;
}

TEST(PcdRules, Binary) {
  const RuleCase cases[] = {
      {"good compressed", kCompressed, 2, ""},
      {"binary, one byte short", kBinary.substr(0, kBinary.size() - 1), kRefused, "byte 164"},
      {"binary, one byte more", kBinary + "!", 2, "1 bytes after"},
      {"binary, body in CR LF style", changed(kBinary, "DATA binary\n", "DATA binary\r\n"), 2, "some lines"},
      {"binary, 2^31 - 1 points",
       changed(changed(kBinary, "WIDTH 2", "WIDTH 2147483647"), "POINTS 2", "POINTS 2147483647"), kRefused,
       "2147483647 rows"},
      {"compressed, sizes cut", kCompressed.substr(0, kCompressed.size() - 28), kRefused, "two sizes"},
      {"compressed, one byte short", kCompressed.substr(0, kCompressed.size() - 1), kRefused, "compressed size"},
      {"compressed, one byte more", kCompressed + "!", 2, "1 bytes after"},
      {"compressed, zeros up to a page, as PCL writes them", kCompressed + std::string(4095, '\0'), 2, ""},
      {"compressed, more zeros than that", kCompressed + std::string(4096, '\0'), 2, "4096 bytes after"},
      {"compressed, wrong unpacked size",
       changed(kCompressed, std::string("\x18\0\0\0", 4), std::string("\x19\0\0\0", 4)), kRefused,
       "uncompressed size of 24"},
      {"compressed, run beyond the output", changed(kCompressed, "\x17", "\x18"), kRefused, "broken stream"},
      {"compressed, run beyond the input",
       changed(kCompressed, std::string("\x19\0\0\0", 4), std::string("\x18\0\0\0", 4)), kRefused, "broken stream"},
      {"compressed, reference to before the start",
       changed(kCompressed, std::string("\x17?", 2), std::string("\xe0?", 2)), kRefused, "broken stream"},
      {"compressed, nothing for 24 bytes", kHeader + "DATA binary_compressed\n" + std::string("\0\0\0\0\x18\0\0\0", 8),
       kRefused, "broken stream"},
      {"compressed, more than LZF can make",
       changed(changed(kHeader, "WIDTH 2", "WIDTH 1000"), "POINTS 2", "POINTS 1000") + "DATA binary_compressed\n" +
           std::string("\x04\0\0\0\xe0\x2e\0\0", 8) + "????",
       kRefused, "at most 384"}};
  for (const RuleCase& rule : cases)
    expectRule(rule, "a.pcd");
}

TEST(PcdRules, PaddingIsDroppedFromBinaryRowsAndCompressedColumns) {
  const std::string fields =
      "VERSION 0.7\nFIELDS x _ y z\nSIZE 1 1 1 1\nTYPE U U U U\nCOUNT 1 3 1 1\nWIDTH 2\nHEIGHT 1\n";
  const std::string binary = fields + "DATA binary\n\x01___\x02\x03\x04___\x05\x06";
  const std::string compressed =
      fields + "DATA binary_compressed\n" + std::string("\x0d\0\0\0\x0c\0\0\0\x0b\x01\x04______\x02\x05\x03\x06", 21);
  for (const std::string& text : {binary, compressed}) {
    const CloudFile cloud = readText(text, "a.pcd");
    ASSERT_EQ(cloud.fields.size(), 3U);
    EXPECT_EQ(cloud.pointStep(), 3U);
    EXPECT_EQ(cloud.data, (std::vector<unsigned char>{1, 2, 3, 4, 5, 6}));
  }
}

} // namespace
} // namespace pcl_gpf::test
