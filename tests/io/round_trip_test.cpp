// SPDX-License-Identifier: BSD-3-Clause
// What is written is read back: the same bits, names, types, order, organisation, viewpoint and comments.
#include <gtest/gtest.h>

#include <cmath>

#include "io/test_clouds.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

bool isPly(CloudFormat format) {
  return extensionFor(format) == ".ply";
}

CloudFile writtenAndRead(const CloudFile& cloud, CloudFormat format) {
  const TemporaryFolder folder;
  const std::string path = folder / ("cloud" + extensionFor(format));
  WriteOptions options;
  options.format = format;
  writeCloud(cloud, path, options);
  EXPECT_EQ(folder.entries(), 1);
  CloudFile result = readCloud(path);
  EXPECT_EQ(result.format, format);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  return result;
}

void expectSameFields(const CloudFile& expected, const CloudFile& actual) {
  ASSERT_EQ(actual.fields.size(), expected.fields.size());
  for (std::size_t f = 0; f < expected.fields.size(); ++f) {
    EXPECT_EQ(actual.fields[f].name, expected.fields[f].name);
    EXPECT_EQ(actual.fields[f].type, expected.fields[f].type) << expected.fields[f].name;
    EXPECT_EQ(actual.fields[f].count, expected.fields[f].count) << expected.fields[f].name;
    EXPECT_EQ(actual.fields[f].offset, expected.fields[f].offset) << expected.fields[f].name;
  }
}

void expectSameCloud(const CloudFile& expected, const CloudFile& actual) {
  expectSameFields(expected, actual);
  EXPECT_EQ(actual.width, expected.width);
  EXPECT_EQ(actual.height, expected.height);
  EXPECT_EQ(actual.viewpoint, expected.viewpoint);
  EXPECT_EQ(actual.comments, expected.comments);
  EXPECT_TRUE(actual.data == expected.data);
}

TEST(RoundTrip, MixedFieldsInPcdKeepEveryBit) {
  for (const CloudFormat format : {CloudFormat::PcdAscii, CloudFormat::PcdBinary, CloudFormat::PcdCompressed}) {
    SCOPED_TRACE(nameOf(format));
    const CloudFile cloud = mixedCloud(64, 48, 1);
    expectSameCloud(cloud, writtenAndRead(cloud, format));
  }
}

TEST(RoundTrip, MixedFieldsInPlyKeepEveryBitOfWhatPlyHas) {
  for (const CloudFormat format : {CloudFormat::PlyAscii, CloudFormat::PlyLittleEndian, CloudFormat::PlyBigEndian}) {
    SCOPED_TRACE(nameOf(format));
    CloudFile cloud = mixedCloud(64, 48, 2);
    limitWideIntegers(cloud);
    CloudFile result = writtenAndRead(cloud, format);
    // PLY has no 64-bit integers: doubles of the same value stand for them.
    for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
      if (cloud.fields[f].type != FieldType::Int64 && cloud.fields[f].type != FieldType::UInt64) continue;
      EXPECT_EQ(result.fields[f].type, FieldType::Float64);
      for (std::size_t i = 0; i < cloud.size(); ++i)
        for (std::size_t k = 0; k < cloud.fields[f].count; ++k)
          ASSERT_EQ(result.value(i, static_cast<int>(f), k), cloud.value(i, static_cast<int>(f), k));
      for (std::size_t i = 0; i < cloud.size(); ++i)
        std::memcpy(result.data.data() + i * cloud.pointStep() + cloud.fields[f].offset,
                    cloud.data.data() + i * cloud.pointStep() + cloud.fields[f].offset, 8 * cloud.fields[f].count);
      result.fields[f].type = cloud.fields[f].type;
    }
    expectSameCloud(cloud, result);
  }
}

TEST(RoundTrip, EveryTypeOfCoordinateInEveryFormat) {
  for (const FieldType type : kAllTypes) {
    for (const CloudFormat format : kAllFormats) {
      SCOPED_TRACE(std::string(nameOf(type)) + " in " + nameOf(format));
      CloudFile cloud;
      cloud.width = 1000;
      for (const char* name : {"x", "y", "z"})
        cloud.addField(name, type);
      fillRandom(cloud, 3);
      if (format == CloudFormat::Xyz || isPly(format)) limitWideIntegers(cloud);
      const CloudFile result = writtenAndRead(cloud, format);
      const bool keeps_types = format != CloudFormat::Xyz && !(isPly(format) && sizeOf(type) == 8);
      if (keeps_types) expectSameCloud(cloud, result);
      ASSERT_EQ(result.size(), cloud.size());
      for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < cloud.size(); ++i) {
          const double expected = cloud.value(i, axis);
          // Text of a float is the shortest that gives the same float, which XYZ reads as a double.
          const double actual =
              type == FieldType::Float32 ? static_cast<float>(result.value(i, axis)) : result.value(i, axis);
          if (std::isnan(expected))
            ASSERT_TRUE(std::isnan(actual));
          else
            ASSERT_EQ(actual, expected);
        }
      }
    }
  }
}

TEST(RoundTrip, OneMillionFloatsThroughText) {
  CloudFile cloud;
  cloud.width = 350000;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float32);
  fillRandom(cloud, 4);
  EXPECT_TRUE(writtenAndRead(cloud, CloudFormat::PcdAscii).data == cloud.data);
  EXPECT_TRUE(writtenAndRead(cloud, CloudFormat::PlyAscii).data == cloud.data);
}

TEST(RoundTrip, Extremes) {
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    CloudFile cloud;
    cloud.width = 6;
    for (const char* name : {"x", "y", "z"})
      cloud.addField(name, FieldType::Float64);
    cloud.addField("f", FieldType::Float32);
    const double infinity = std::numeric_limits<double>::infinity();
    const double values[6] = {
        0.0, -0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(), -infinity, 0.1};
    const double float_values[6] = {std::numeric_limits<float>::denorm_min(),
                                    std::numeric_limits<float>::max(),
                                    -0.0,
                                    infinity,
                                    static_cast<double>(0.1F),
                                    16777217.0};
    for (std::size_t i = 0; i < 6; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        cloud.setValue(i, axis, values[i]);
      cloud.setValue(i, 3, float_values[i]);
    }
    const CloudFile result = writtenAndRead(cloud, format);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(result.value(i, 0), values[i]);
      EXPECT_EQ(std::signbit(result.value(i, 0)), std::signbit(values[i]));
      EXPECT_EQ(static_cast<float>(result.value(i, 3)), static_cast<float>(float_values[i]));
    }
  }
}

TEST(RoundTrip, NoPointsAndOnePoint) {
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    const CloudFile one = cloudOf({{{1, 2, 3}}});
    EXPECT_EQ(writtenAndRead(one, format).size(), 1U);
    if (format == CloudFormat::Xyz) continue; // text without a row is refused
    const CloudFile none = cloudOf({});
    EXPECT_EQ(writtenAndRead(none, format).size(), 0U);
  }
}

TEST(RoundTrip, RowsLargerThanABlock) {
  CloudFile cloud;
  cloud.width = 3;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float32);
  cloud.addField("big", FieldType::UInt16, 700000);
  fillRandom(cloud, 5);
  for (const CloudFormat format : {CloudFormat::PcdBinary, CloudFormat::PcdCompressed, CloudFormat::PlyBigEndian}) {
    SCOPED_TRACE(nameOf(format));
    expectSameCloud(cloud, writtenAndRead(cloud, format));
  }
}

TEST(RoundTrip, CompressedRepeatsShrinkAndRandomBytesHardlyGrow) {
  const TemporaryFolder folder;
  CloudFile zeros;
  zeros.width = 100000;
  for (const char* name : {"x", "y", "z"})
    zeros.addField(name, FieldType::Float32);
  CloudFile random = zeros;
  fillRandom(random, 6);
  WriteOptions options;
  options.format = CloudFormat::PcdCompressed;
  writeCloud(zeros, folder / "zeros.pcd", options);
  writeCloud(random, folder / "random.pcd", options);
  EXPECT_LT(std::filesystem::file_size(folder / "zeros.pcd"), zeros.data.size() / 80);
  EXPECT_LT(std::filesystem::file_size(folder / "random.pcd"), random.data.size() * 33 / 32 + 1000);
  EXPECT_TRUE(readCloud(folder / "zeros.pcd").data == zeros.data);
  EXPECT_TRUE(readCloud(folder / "random.pcd").data == random.data);
}

TEST(RoundTrip, CommentsCannotBreakAHeader) {
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    CloudFile cloud = cloudOf({{{1, 2, 3}}});
    cloud.comments = {"one\nelement vertex 7\r\nDATA ascii", "", std::string("a\0b", 3), std::string(2 << 20, 'x')};
    const CloudFile result = writtenAndRead(cloud, format);
    EXPECT_EQ(result.comments, (std::vector<std::string>{"one", "element vertex 7", "DATA ascii", "ab"}));
  }
}

} // namespace
} // namespace pcl_gpf::test
