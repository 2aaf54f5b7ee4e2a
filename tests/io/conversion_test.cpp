// SPDX-License-Identifier: BSD-3-Clause
// Normals and colours change their names and packing between the formats, and come back as they were.
#include <gtest/gtest.h>

#include "io/test_clouds.h"
#include "pcl_gpf/io/errors.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

CloudFile through(const CloudFile& cloud, CloudFormat format) {
  const TemporaryFolder folder;
  const std::string path = folder / ("cloud" + extensionFor(format));
  WriteOptions options;
  options.format = format;
  writeCloud(cloud, path, options);
  return readCloud(path);
}

std::string namesOf(const CloudFile& cloud) {
  std::string names;
  for (const CloudField& field : cloud.fields)
    names += field.name + ':' + nameOf(field.type) + ' ';
  return names;
}

const std::string kXyz = "x:float32 y:float32 z:float32 ";
constexpr CloudFormat kPcd[] = {CloudFormat::PcdAscii, CloudFormat::PcdBinary, CloudFormat::PcdCompressed};
constexpr CloudFormat kPly[] = {CloudFormat::PlyAscii, CloudFormat::PlyLittleEndian, CloudFormat::PlyBigEndian};

CloudFile withChannels(std::initializer_list<const char*> names) {
  CloudFile cloud = cloudOf({{{1, 2, 3}}, {{4, 5, 6}}});
  double value = 200;
  for (const char* name : names) {
    const int field = cloud.addField(name, FieldType::UInt8);
    cloud.setValue(0, field, value);
    cloud.setValue(1, field, value + 50);
    value += 1;
  }
  return cloud;
}

std::uint32_t packedColour(const CloudFile& cloud, std::size_t point) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, cloud.data.data() + point * cloud.pointStep() + cloud.fields[3].offset, sizeof bits);
  return bits;
}

TEST(Conversion, ThreeChannelsBecomeRgbAndComeBack) {
  const CloudFile ply = withChannels({"blue", "red", "green"});
  for (const CloudFormat pcd_format : kPcd) {
    SCOPED_TRACE(nameOf(pcd_format));
    const CloudFile pcd = through(ply, pcd_format);
    EXPECT_EQ(namesOf(pcd), kXyz + "rgb:float32 ");
    EXPECT_EQ(packedColour(pcd, 0), 201U << 16 | 202U << 8 | 200U);
    EXPECT_EQ(packedColour(pcd, 1), 251U << 16 | 252U << 8 | 250U);
    for (const CloudFormat ply_format : kPly) {
      const CloudFile back = through(pcd, ply_format);
      EXPECT_EQ(namesOf(back), kXyz + "red:uint8 green:uint8 blue:uint8 ");
      EXPECT_EQ(back.value(1, 3), 251);
      EXPECT_EQ(back.value(1, 4), 252);
      EXPECT_EQ(back.value(1, 5), 250);
    }
  }
}

TEST(Conversion, FourChannelsBecomeRgbaAndComeBack) {
  const CloudFile ply = withChannels({"red", "green", "blue", "alpha"});
  for (const CloudFormat pcd_format : kPcd) {
    SCOPED_TRACE(nameOf(pcd_format));
    const CloudFile pcd = through(ply, pcd_format);
    EXPECT_EQ(namesOf(pcd), kXyz + "rgba:uint32 ");
    EXPECT_EQ(packedColour(pcd, 0), 203U << 24 | 200U << 16 | 201U << 8 | 202U);
    const CloudFile back = through(pcd, CloudFormat::PlyBigEndian);
    EXPECT_EQ(namesOf(back), namesOf(ply));
    EXPECT_TRUE(back.data == ply.data);
  }
}

TEST(Conversion, AColourWithTheBitsOfANanSurvivesText) {
  CloudFile cloud = cloudOf({{{1, 2, 3}}});
  cloud.addField("rgb", FieldType::Float32);
  const std::uint32_t bits = 0xffc80102; // alpha 255 as new PCL writes it, red 200: a NaN with a payload
  std::memcpy(cloud.data.data() + 12, &bits, sizeof bits);
  for (const CloudFormat format : kPcd)
    EXPECT_EQ(packedColour(through(cloud, format), 0), bits) << nameOf(format);
  for (const CloudFormat format : kPly)
    EXPECT_EQ(through(cloud, format).value(0, 3), 0xc8) << nameOf(format);
  EXPECT_EQ(through(cloud, CloudFormat::Xyz).value(0, 3), 0xc8);
}

TEST(Conversion, OtherColoursAreCarriedAsTheyAre) {
  EXPECT_EQ(namesOf(through(withChannels({"red", "green"}), CloudFormat::PcdBinary)), kXyz + "red:uint8 green:uint8 ");
  EXPECT_EQ(namesOf(through(withChannels({"alpha"}), CloudFormat::PcdBinary)), kXyz + "alpha:uint8 ");
  CloudFile floats = cloudOf({{{1, 2, 3}}});
  for (const char* name : {"red", "green", "blue"})
    floats.addField(name, FieldType::Float32);
  EXPECT_EQ(namesOf(through(floats, CloudFormat::PcdBinary)), namesOf(floats));
  CloudFile taken = withChannels({"red", "green", "blue"});
  taken.addField("rgb", FieldType::Float32);
  EXPECT_EQ(namesOf(through(taken, CloudFormat::PcdBinary)), namesOf(taken));
  EXPECT_EQ(namesOf(through(taken, CloudFormat::PlyAscii)), namesOf(taken));
  CloudFile both = cloudOf({{{1, 2, 3}}});
  both.addField("rgb", FieldType::Float32);
  both.addField("rgba", FieldType::UInt32);
  EXPECT_EQ(namesOf(through(both, CloudFormat::PlyAscii)),
            kXyz + "rgb:float32 red:uint8 green:uint8 blue:uint8 alpha:uint8 ");
  EXPECT_EQ(namesOf(through(both, CloudFormat::PcdAscii)), namesOf(both));
  CloudFile wide = cloudOf({{{1, 2, 3}}});
  wide.addField("rgb", FieldType::Float32, 2);
  EXPECT_EQ(namesOf(through(wide, CloudFormat::PlyAscii)), namesOf(wide));
}

TEST(Conversion, NormalsHaveTheNamesOfEachFormat) {
  CloudFile cloud = cloudOf({{{1, 2, 3}}});
  for (const char* name : {"normal_x", "normal_y", "normal_z", "curvature"})
    cloud.addField(name, FieldType::Float32);
  cloud.setValue(0, 4, 0.25);
  EXPECT_TRUE(cloud.hasNormals());
  const TemporaryFolder folder;
  for (const CloudFormat format : kAllFormats) {
    SCOPED_TRACE(nameOf(format));
    const std::string path = folder / ("a" + extensionFor(format));
    WriteOptions options;
    options.format = format;
    options.overwrite = true;
    writeCloud(cloud, path, options);
    const CloudFile result = readCloud(path);
    EXPECT_TRUE(result.hasNormals());
    EXPECT_EQ(result.value(0, result.findField("normal_y")), 0.25);
    const bool has_ply_names =
        bytesOf(path).find("property float nx\nproperty float ny\nproperty float nz\n") != std::string::npos;
    EXPECT_EQ(has_ply_names, extensionFor(format) == ".ply");
  }
}

TEST(Conversion, NamesThatAreTakenAreNotTakenTwice) {
  CloudFile cloud = cloudOf({{{1, 2, 3}}});
  for (const char* name : {"nx", "normal_x", "ny", "_", "__"})
    cloud.addField(name, FieldType::Float32);
  EXPECT_EQ(through(cloud, CloudFormat::PlyAscii).fields.size(), 8U);
  EXPECT_EQ(through(cloud, CloudFormat::PcdAscii).findField("___"), 6);
  EXPECT_EQ(through(cloud, CloudFormat::Xyz).fields.size(), 8U);
}

TEST(Conversion, FormatForPathFollowsExtensionAndFlavour) {
  CloudFile cloud;
  const auto format = [&](CloudFormat read_as, const char* path) {
    cloud.format = read_as;
    return formatForPath(path, cloud);
  };
  for (const CloudFormat same : kPcd)
    EXPECT_EQ(format(same, "a.PCD"), same);
  for (const CloudFormat same : kPly)
    EXPECT_EQ(format(same, "b/a.ply"), same);
  for (const CloudFormat same : kAllFormats)
    EXPECT_EQ(format(same, "-"), same);
  for (const CloudFormat any : kAllFormats)
    EXPECT_EQ(format(any, "a.xyz"), CloudFormat::Xyz);
  EXPECT_EQ(format(CloudFormat::PlyAscii, "a.pcd"), CloudFormat::PcdAscii);
  EXPECT_EQ(format(CloudFormat::Xyz, "a.pcd"), CloudFormat::PcdAscii);
  EXPECT_EQ(format(CloudFormat::PlyBigEndian, "a.pcd"), CloudFormat::PcdBinary);
  EXPECT_EQ(format(CloudFormat::PcdAscii, "a.ply"), CloudFormat::PlyAscii);
  EXPECT_EQ(format(CloudFormat::PcdCompressed, "a.ply"), CloudFormat::PlyLittleEndian);
  for (const char* path : {"a", "a.csv", "a.las", "a.ply/b", ""})
    EXPECT_THROW(formatForPath(path, cloud), IoError) << path;
}

} // namespace
} // namespace pcl_gpf::test
