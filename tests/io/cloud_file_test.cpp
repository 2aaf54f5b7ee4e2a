// SPDX-License-Identifier: BSD-3-Clause
// Laws of the container.
#include "pcl_gpf/io/cloud_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/test_clouds.h"

namespace pcl_gpf::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CloudFile, ValuesAreRoundedToTheTypeAndNeverClamped) {
  struct Row {
    FieldType type;
    double lowest, highest; // inclusive, after rounding
  };
  const Row rows[] = {{FieldType::Int8, -128, 127},
                      {FieldType::UInt8, 0, 255},
                      {FieldType::Int16, -32768, 32767},
                      {FieldType::UInt16, 0, 65535},
                      {FieldType::Int32, -2147483648.0, 2147483647.0},
                      {FieldType::UInt32, 0, 4294967295.0}};
  for (const Row& row : rows) {
    SCOPED_TRACE(nameOf(row.type));
    CloudFile cloud;
    cloud.width = 1;
    const int field = cloud.addField("a", row.type);
    for (const double value : {row.lowest, row.highest, row.lowest - 0.4, row.highest + 0.4}) {
      cloud.setValue(0, field, value);
      EXPECT_EQ(cloud.value(0, field), std::nearbyint(value));
    }
    cloud.setValue(0, field, 7);
    for (const double value : {row.lowest - 1, row.highest + 1, 1e300, -1e300, kNan, HUGE_VAL}) {
      EXPECT_THROW(cloud.setValue(0, field, value), std::out_of_range) << value;
      EXPECT_EQ(cloud.value(0, field), 7) << "a refused value changed the field";
    }
  }
}

TEST(CloudFile, WideIntegersAndRealsHaveTheirOwnLimits) {
  CloudFile cloud;
  cloud.width = 1;
  const int i64 = cloud.addField("i64", FieldType::Int64);
  const int u64 = cloud.addField("u64", FieldType::UInt64);
  const int f32 = cloud.addField("f32", FieldType::Float32);
  const int f64 = cloud.addField("f64", FieldType::Float64);
  cloud.setValue(0, i64, -0x1p63);
  EXPECT_EQ(cloud.value(0, i64), -0x1p63);
  EXPECT_THROW(cloud.setValue(0, i64, 0x1p63), std::out_of_range);
  cloud.setValue(0, u64, 0x1p63);
  EXPECT_EQ(cloud.value(0, u64), 0x1p63);
  EXPECT_THROW(cloud.setValue(0, u64, 0x1p64), std::out_of_range);
  EXPECT_THROW(cloud.setValue(0, u64, -1), std::out_of_range);
  cloud.setValue(0, f32, 0.1);
  EXPECT_EQ(cloud.value(0, f32), static_cast<double>(0.1F));
  EXPECT_THROW(cloud.setValue(0, f32, 1e39), std::out_of_range);
  EXPECT_THROW(cloud.setValue(0, f32, 0x1.ffffffp127), std::out_of_range);
  cloud.setValue(0, f32, 0x1.fffffefffffffp127); // the last double that rounds down to a float
  EXPECT_EQ(cloud.value(0, f32), std::numeric_limits<float>::max());
  cloud.setValue(0, f32, HUGE_VAL);
  EXPECT_EQ(cloud.value(0, f32), HUGE_VAL);
  cloud.setValue(0, f32, kNan);
  EXPECT_TRUE(std::isnan(cloud.value(0, f32)));
  cloud.setValue(0, f64, 1e300);
  EXPECT_EQ(cloud.value(0, f64), 1e300);
}

TEST(CloudFile, AddedFieldsKeepTheOthersAndStartWithZeros) {
  CloudFile cloud = mixedCloud(5, 4, 1);
  const CloudFile before = cloud;
  const int field = cloud.addField("new", FieldType::Int16, 3);
  EXPECT_EQ(field, 12);
  EXPECT_EQ(cloud.pointStep(), before.pointStep() + 6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ(std::memcmp(cloud.data.data() + i * cloud.pointStep(), before.data.data() + i * before.pointStep(),
                          before.pointStep()),
              0);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(cloud.value(i, field, k), 0);
  }
  EXPECT_THROW(cloud.addField("new", FieldType::Int8), std::invalid_argument);
  EXPECT_THROW(cloud.addField("", FieldType::Int8), std::invalid_argument);
  EXPECT_THROW(cloud.addField("a b", FieldType::Int8), std::invalid_argument);
  EXPECT_THROW(cloud.addField(std::string("a\0b", 3), FieldType::Int8), std::invalid_argument);
  EXPECT_THROW(cloud.addField("none", FieldType::Int8, 0), std::invalid_argument);
}

TEST(CloudFile, ColumnsAndCoordinatesAreTheValues) {
  CloudFile cloud = mixedCloud(6, 3, 2);
  const CloudCoordinates all = cloud.coordinates();
  const int fields[3] = {cloud.findField("x"), cloud.findField("y"), cloud.findField("z")};
  const std::vector<double>* axes[3] = {&all.x, &all.y, &all.z};
  std::size_t finite = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    bool is_finite = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = cloud.value(i, fields[axis]);
      is_finite = is_finite && std::isfinite(value);
      if (std::isnan(value))
        EXPECT_TRUE(std::isnan((*axes[axis])[i]));
      else
        EXPECT_EQ((*axes[axis])[i], value);
    }
    finite += is_finite;
  }
  EXPECT_EQ(cloud.finiteCount(), finite);
  EXPECT_LT(finite, cloud.size());
  std::vector<double> column = cloud.column(cloud.findField("u16"));
  for (double& value : column)
    value = 65535 - value;
  cloud.setColumn(cloud.findField("u16"), column);
  EXPECT_EQ(cloud.column(cloud.findField("u16")), column);
  column.pop_back();
  EXPECT_THROW(cloud.setColumn(cloud.findField("u16"), column), std::invalid_argument);
  cloud.setCoordinate(3, 1, -2.5);
  EXPECT_EQ(cloud.value(3, fields[1]), -2.5);
  EXPECT_THROW(cloud.setCoordinate(3, 3, 0), std::invalid_argument);
  EXPECT_THROW(cloud.setCoordinate(18, 0, 0), std::out_of_range);
}

TEST(CloudFile, SelectedRowsAreTheRows) {
  const CloudFile cloud = mixedCloud(5, 4, 3);
  const std::vector<int> indices = {19, 0, 7, 7};
  const CloudFile selected = cloud.select(indices);
  EXPECT_EQ(selected.width, 4U);
  EXPECT_EQ(selected.height, 1U);
  EXPECT_EQ(selected.viewpoint, cloud.viewpoint);
  EXPECT_EQ(selected.comments, cloud.comments);
  const std::size_t step = cloud.pointStep();
  for (std::size_t i = 0; i < indices.size(); ++i)
    EXPECT_EQ(std::memcmp(selected.data.data() + i * step,
                          cloud.data.data() + static_cast<std::size_t>(indices[i]) * step, step),
              0);
  EXPECT_EQ(cloud.select({}).size(), 0U);
  EXPECT_EQ(cloud.select({1, 2}).size(), 2U);
  EXPECT_THROW(cloud.select({20}), std::out_of_range);
  EXPECT_THROW(cloud.select(std::vector<int>{-1}), std::out_of_range);
}

TEST(CloudFile, WrongPlacesAreRefused) {
  CloudFile cloud = cloudOf({{{1, 2, 3}}});
  EXPECT_THROW(cloud.value(1, 0), std::out_of_range);
  EXPECT_THROW(cloud.value(0, 3), std::out_of_range);
  EXPECT_THROW(cloud.value(0, -1), std::out_of_range);
  EXPECT_THROW(cloud.value(0, 0, 1), std::out_of_range);
  EXPECT_THROW(cloud.column(3), std::out_of_range);
  EXPECT_EQ(cloud.findField("w"), -1);
  EXPECT_FALSE(cloud.hasNormals());
  EXPECT_THROW(CloudFile().finiteCount(), std::invalid_argument);
  EXPECT_EQ(CloudFile().size(), 0U);
}

} // namespace
} // namespace pcl_gpf::test
