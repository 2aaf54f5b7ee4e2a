// SPDX-License-Identifier: BSD-3-Clause
// PCL reads what is written here, and the other way round; PCL's cloud in memory keeps every bit.
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

#include "io/test_clouds.h"
#include "pcl_gpf/io/pcl_conversions.h"
#include "pcl_gpf/io/read_cloud.h"
#include "pcl_gpf/io/write_cloud.h"

namespace pcl_gpf::test {
namespace {

using Point = pcl::PointXYZRGBNormal;

/** Finite random points with normals and colour, and with NaN holes where it is organised. */
CloudFile colouredCloud(std::uint32_t width, std::uint32_t height) {
  CloudFile cloud;
  cloud.width = width;
  cloud.height = height;
  for (const char* name : {"x", "y", "z", "rgb", "normal_x", "normal_y", "normal_z", "curvature"})
    cloud.addField(name, FieldType::Float32);
  std::mt19937 generator(1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const int field : {0, 1, 2, 4, 5, 6, 7})
      cloud.setValue(i, field, static_cast<double>(generator()) * 1e-9 - 2);
    const std::uint32_t colour = generator() & 0xffffff;
    std::memcpy(cloud.data.data() + i * cloud.pointStep() + 12, &colour, sizeof colour);
    if (height > 1 && i % 5 == 0) cloud.setValue(i, 0, std::numeric_limits<double>::quiet_NaN());
  }
  return cloud;
}

void expectSamePoints(const CloudFile& ours, const pcl::PointCloud<Point>& theirs) {
  ASSERT_EQ(theirs.size(), ours.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Point& point = theirs[i];
    const float values[7] = {point.x,        point.y,        point.z,        point.normal_x,
                             point.normal_y, point.normal_z, point.curvature};
    const int fields[7] = {0, 1, 2, 4, 5, 6, 7};
    for (std::size_t v = 0; v < 7; ++v) {
      const double expected = ours.value(i, fields[v]);
      if (std::isnan(expected))
        ASSERT_TRUE(std::isnan(values[v]));
      else
        ASSERT_EQ(values[v], expected) << "point " << i << " field " << fields[v];
    }
    std::uint32_t colour = 0;
    std::memcpy(&colour, ours.data.data() + i * ours.pointStep() + 12, sizeof colour);
    ASSERT_EQ(point.rgba & 0xffffff, colour);
  }
}

pcl::PointCloud<Point> readByPcl(const std::string& path) {
  pcl::PointCloud<Point> cloud;
  const bool is_pcd = path.substr(path.size() - 4) == ".pcd";
  EXPECT_EQ(is_pcd ? pcl::io::loadPCDFile(path, cloud) : pcl::io::loadPLYFile(path, cloud), 0);
  return cloud;
}

TEST(PclCrossCheck, PclReadsWhatWeWrite) {
  const TemporaryFolder folder;
  const CloudFile flat = colouredCloud(5000, 1);
  const CloudFile organised = colouredCloud(80, 60);
  for (const CloudFormat format : kAllFormats) {
    if (format == CloudFormat::Xyz) continue;
    SCOPED_TRACE(nameOf(format));
    for (const CloudFile* cloud : {&flat, &organised}) {
      const std::string path = folder / ("a" + extensionFor(format));
      WriteOptions options;
      options.format = format;
      options.overwrite = true;
      writeCloud(*cloud, path, options);
      const pcl::PointCloud<Point> theirs = readByPcl(path);
      expectSamePoints(*cloud, theirs);
      EXPECT_EQ(theirs.width, cloud->width);
      EXPECT_EQ(theirs.height, cloud->height);
    }
  }
}

TEST(PclCrossCheck, PclReadsOurCompressedBodyOfEveryKind) {
  const TemporaryFolder folder;
  CloudFile cloud = mixedCloud(100, 20, 2);
  WriteOptions options;
  options.format = CloudFormat::PcdCompressed;
  writeCloud(cloud, folder / "a.pcd", options);
  pcl::PCLPointCloud2 theirs;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  ASSERT_EQ(pcl::PCDReader().read(folder / "a.pcd", theirs, origin, orientation, version), 0);
  EXPECT_EQ(theirs.data.size(), cloud.data.size());
  EXPECT_TRUE(std::equal(cloud.data.begin(), cloud.data.end(), theirs.data.begin(), theirs.data.end()));
  EXPECT_EQ(origin.y(), static_cast<float>(cloud.viewpoint[1]));
  EXPECT_EQ(orientation.x(), -0.5F);
}

TEST(PclCrossCheck, WeReadWhatPclWrites) {
  const TemporaryFolder folder;
  const CloudFile expected = colouredCloud(70, 50);
  pcl::PointCloud<Point> cloud;
  pcl::fromPCLPointCloud2(toPCL(expected), cloud);
  cloud.sensor_origin_ = Eigen::Vector4f(1.5F, -2, 3, 0);
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5F, 0.5F, -0.5F, 0.5F);
  pcl::PCDWriter pcd;
  ASSERT_EQ(pcd.writeASCII(folder / "ascii.pcd", cloud, 9), 0);
  ASSERT_EQ(pcd.writeBinary(folder / "binary.pcd", cloud), 0);
  ASSERT_EQ(pcd.writeBinaryCompressed(folder / "compressed.pcd", cloud), 0);
  pcl::PLYWriter ply;
  ASSERT_EQ(ply.write(folder / "ascii.ply", cloud, false, true), 0);
  ASSERT_EQ(ply.write(folder / "binary.ply", cloud, true, true), 0);
  for (const char* name : {"ascii.pcd", "binary.pcd", "compressed.pcd", "ascii.ply", "binary.ply"}) {
    SCOPED_TRACE(name);
    const CloudFile ours = readCloud(folder / name);
    ASSERT_EQ(ours.size(), expected.size());
    EXPECT_TRUE(ours.warnings.empty());
    EXPECT_TRUE(ours.hasNormals());
    EXPECT_EQ(ours.finiteCount(), expected.finiteCount());
    pcl::PointCloud<Point> converted;
    pcl::fromPCLPointCloud2(toPCL(ours), converted);
    const bool text_of_ply = std::string(name) == "ascii.ply"; // PCL writes only 8 digits there
    if (!text_of_ply) expectSamePoints(expected, converted);
    for (std::size_t k = 0; k < 7; ++k) {
      const double viewpoint[7] = {1.5, -2, 3, 0.5, 0.5, -0.5, 0.5};
      EXPECT_NEAR(ours.viewpoint[k], viewpoint[k], 1e-6) << k;
    }
  }
}

TEST(PclCrossCheck, ConversionToPclAndBackKeepsEveryBit) {
  const CloudFile cloud = mixedCloud(30, 20, 3);
  const pcl::PCLPointCloud2 theirs = toPCL(cloud);
  EXPECT_FALSE(theirs.is_dense);
  EXPECT_EQ(theirs.width, 30U);
  EXPECT_EQ(theirs.height, 20U);
  const CloudFile back = fromPCL(theirs);
  ASSERT_EQ(back.fields.size(), cloud.fields.size());
  for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
    EXPECT_EQ(back.fields[f].name, cloud.fields[f].name);
    EXPECT_EQ(back.fields[f].type, cloud.fields[f].type);
    EXPECT_EQ(back.fields[f].count, cloud.fields[f].count);
  }
  EXPECT_TRUE(back.data == cloud.data);
  EXPECT_EQ(back.height, 20U);
}

TEST(PclCrossCheck, PaddingOfPclPointsIsDropped) {
  pcl::PointCloud<pcl::PointNormal> points;
  points.resize(3);
  points[2].x = 7;
  points[2].curvature = 0.5F;
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(points, blob);
  const CloudFile cloud = fromPCL(blob);
  EXPECT_LT(cloud.pointStep(), blob.point_step);
  EXPECT_EQ(cloud.pointStep(), 28U);
  EXPECT_EQ(cloud.value(2, cloud.findField("x")), 7);
  EXPECT_EQ(cloud.value(2, cloud.findField("curvature")), 0.5);
  EXPECT_EQ(fromPCL(pcl::PCLPointCloud2()).size(), 0U);
}

TEST(PclCrossCheck, InconsistentPclCloudsAreRefused) {
  const pcl::PCLPointCloud2 good = toPCL(colouredCloud(4, 2));
  pcl::PCLPointCloud2 broken = good;
  broken.data.pop_back();
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.fields.back().offset = good.point_step - 3;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.fields.back().count = 2;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.fields.back().datatype = 99;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.width = 1U << 31;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.row_step = 1;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
  broken = good;
  broken.is_bigendian = !good.is_bigendian;
  EXPECT_THROW(fromPCL(broken), std::invalid_argument);
}

} // namespace
} // namespace pcl_gpf::test
