// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/pcl_conversions.h"

#include <limits>
#include <stdexcept>

#include "io/element_bytes.h"
#include "io/output_layout.h"

namespace pcl_gpf {

namespace {

struct TypePair {
  FieldType ours;
  int pcl;
};

constexpr TypePair kTypes[] = {
    {FieldType::Int8, pcl::PCLPointField::INT8},       {FieldType::UInt8, pcl::PCLPointField::UINT8},
    {FieldType::Int16, pcl::PCLPointField::INT16},     {FieldType::UInt16, pcl::PCLPointField::UINT16},
    {FieldType::Int32, pcl::PCLPointField::INT32},     {FieldType::UInt32, pcl::PCLPointField::UINT32},
    {FieldType::Int64, pcl::PCLPointField::INT64},     {FieldType::UInt64, pcl::PCLPointField::UINT64},
    {FieldType::Float32, pcl::PCLPointField::FLOAT32}, {FieldType::Float64, pcl::PCLPointField::FLOAT64},
    {FieldType::UInt8, pcl::PCLPointField::BOOL}};

std::uint8_t toPclType(FieldType type) {
  for (const TypePair& pair : kTypes)
    if (pair.ours == type) return static_cast<std::uint8_t>(pair.pcl);
  throw std::invalid_argument("unknown field type");
}

FieldType fromPclType(int type) {
  for (const TypePair& pair : kTypes)
    if (pair.pcl == type) return pair.ours;
  throw std::invalid_argument("a PCL field has the unknown type " + std::to_string(type));
}

/** The fields without padding and how the rows get there; checks all that is used later. */
RowMap packFields(const pcl::PCLPointCloud2& cloud, CloudFile& result) {
  RowMap map;
  std::size_t step = 0;
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name == "_") continue;
    const FieldType type = fromPclType(field.datatype);
    // Old PCL files leave the count at 0 and mean 1.
    const std::uint32_t count = std::max<std::uint32_t>(1, field.count);
    const std::size_t bytes = sizeOf(type) * count;
    if (field.offset > cloud.point_step || bytes > cloud.point_step - field.offset)
      throw std::invalid_argument("the PCL field '" + field.name + "' reaches beyond its row");
    map.add(field.offset, step, bytes);
    result.addField(field.name, type, count);
    step += bytes;
  }
  return map;
}

} // namespace

pcl::PCLPointCloud2 toPCL(const CloudFile& cloud) {
  const OutputLayout layout = pcdLayout(cloud);
  constexpr std::size_t kLimit = std::numeric_limits<std::uint32_t>::max();
  if (layout.step * cloud.width > kLimit)
    throw std::length_error("a row of the cloud has more than 4 GiB, too much for PCL");
  pcl::PCLPointCloud2 result;
  for (const CloudField& field : layout.fields) {
    pcl::PCLPointField& target = result.fields.emplace_back();
    target.name = field.name;
    target.datatype = toPclType(field.type);
    target.count = field.count;
    target.offset = static_cast<std::uint32_t>(field.offset);
  }
  result.width = cloud.width;
  result.height = cloud.height;
  result.point_step = static_cast<std::uint32_t>(layout.step);
  result.row_step = static_cast<std::uint32_t>(layout.step * cloud.width);
  result.is_bigendian = !kHostIsLittleEndian;
  result.is_dense = cloud.finiteCount() == cloud.size();
  result.data.resize(cloud.size() * layout.step);
  layout.map.apply(cloud.data.data(), cloud.pointStep(), result.data.data(), layout.step, cloud.size());
  return result;
}

CloudFile fromPCL(const pcl::PCLPointCloud2& cloud) {
  if (static_cast<bool>(cloud.is_bigendian) == kHostIsLittleEndian)
    throw std::invalid_argument("the PCL cloud has the byte order of another machine");
  CloudFile result;
  const RowMap map = packFields(cloud, result);
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  const std::size_t row_step = cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * cloud.point_step;
  const std::size_t row_bytes = std::size_t{cloud.width} * cloud.point_step;
  if (points > 0 && (row_step < row_bytes || cloud.data.size() < row_step * (cloud.height - 1) + row_bytes))
    throw std::invalid_argument("the PCL cloud's data do not hold width x height points");
  result.width = points == 0 ? 0 : cloud.width;
  result.height = points == 0 ? 1 : cloud.height;
  const std::size_t step = result.pointStep();
  result.data.resize(points * step);
  for (std::size_t row = 0; points > 0 && row < cloud.height; ++row)
    map.apply(cloud.data.data() + row * row_step, cloud.point_step, result.data.data() + row * cloud.width * step, step,
              cloud.width);
  return result;
}

} // namespace pcl_gpf
