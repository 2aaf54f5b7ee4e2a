// SPDX-License-Identifier: BSD-3-Clause
#include "field_types.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_gpf {

namespace {

bool
contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Fields of `cloud` with the new types and offsets, no points yet. */
CloudFile
retyped(const CloudFile& cloud, const std::vector<std::string>& names, FieldType type)
{
  CloudFile result;
  result.width = cloud.width;
  result.height = cloud.height;
  result.viewpoint = cloud.viewpoint;
  result.comments = cloud.comments;
  result.warnings = cloud.warnings;
  result.format = cloud.format;
  std::size_t offset = 0;
  for (CloudField field : cloud.fields) {
    field.type = contains(names, field.name) ? type : field.type;
    field.offset = offset;
    offset += sizeOf(field.type) * field.count;
    result.fields.push_back(field);
  }
  result.data.resize(offset * cloud.size());
  return result;
}

} // namespace

void
changeFieldTypes(CloudFile& cloud, const std::vector<std::string>& names, FieldType type)
{
  CloudFile result = retyped(cloud, names, type);
  const std::size_t from_step = cloud.pointStep();
  const std::size_t to_step = result.pointStep();
  for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
    const CloudField& from = cloud.fields[f];
    const CloudField& to = result.fields[f];
    const std::size_t bytes = sizeOf(from.type) * from.count;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (from.type == to.type)
        std::memcpy(&result.data[i * to_step + to.offset], &cloud.data[i * from_step + from.offset], bytes);
      else
        for (std::size_t e = 0; e < from.count; ++e)
          result.setValue(i, static_cast<int>(f), cloud.value(i, static_cast<int>(f), e), e);
    }
  }
  cloud = std::move(result);
}

std::vector<std::string>
promoteIntegerFields(CloudFile& cloud, const std::vector<std::string>& names, FieldType type)
{
  std::vector<std::string> integers;
  for (const CloudField& field : cloud.fields)
    if (contains(names, field.name) && field.type != FieldType::Float32 && field.type != FieldType::Float64)
      integers.push_back(field.name);
  if (!integers.empty())
    changeFieldTypes(cloud, integers, type);
  return integers;
}

void
widenCoordinates(CloudFile& cloud, const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z)
{
  constexpr double kLargest = std::numeric_limits<float>::max();
  const auto beyond = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value) && std::abs(value) > kLargest; });
  };
  if (beyond(x) || beyond(y) || beyond(z))
    changeFieldTypes(cloud, {"x", "y", "z"}, FieldType::Float64);
}

} // namespace pcl_gpf
