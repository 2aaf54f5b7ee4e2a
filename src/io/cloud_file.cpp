// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_gpf/io/cloud_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "io/element_bytes.h"

namespace pcl_gpf {

namespace {

constexpr const char* kAxisNames[3] = {"x", "y", "z"};

int requireAxis(const CloudFile& cloud, int axis) {
  const int field = axis < 0 || axis > 2 ? -1 : cloud.findField(kAxisNames[axis]);
  if (field < 0) throw std::invalid_argument("the cloud has no field for coordinate axis " + std::to_string(axis));
  return field;
}

} // namespace

std::size_t sizeOf(FieldType type) noexcept {
  switch (type) {
  case FieldType::Int8:
  case FieldType::UInt8:
    return 1;
  case FieldType::Int16:
  case FieldType::UInt16:
    return 2;
  case FieldType::Int32:
  case FieldType::UInt32:
  case FieldType::Float32:
    return 4;
  case FieldType::Int64:
  case FieldType::UInt64:
  case FieldType::Float64:
    break;
  }
  return 8;
}

const char* nameOf(FieldType type) noexcept {
  static constexpr const char* kNames[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                           "uint32", "int64", "uint64", "float32", "float64"};
  return kNames[static_cast<int>(type)];
}

const char* nameOf(CloudFormat format) noexcept {
  static constexpr const char* kNames[] = {"PCD ascii", "PCD binary",        "PCD binary_compressed",
                                           "PLY ascii", "PLY little endian", "PLY big endian",
                                           "XYZ text"};
  return kNames[static_cast<int>(format)];
}

std::size_t CloudFile::pointStep() const noexcept {
  std::size_t step = 0;
  for (const CloudField& field : fields)
    step += sizeOf(field.type) * field.count;
  return step;
}

int CloudFile::findField(const std::string& name) const noexcept {
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == name) return static_cast<int>(i);
  return -1;
}

const unsigned char* CloudFile::element(std::size_t point, int field, std::size_t element) const {
  const CloudField& description = fields.at(static_cast<std::size_t>(field));
  if (point >= size() || element >= description.count) throw std::out_of_range("no such point or element in the cloud");
  return data.data() + point * pointStep() + description.offset + element * sizeOf(description.type);
}

double CloudFile::value(std::size_t point, int field, std::size_t element_index) const {
  const unsigned char* from = element(point, field, element_index);
  return loadElement(fields[static_cast<std::size_t>(field)].type, from);
}

void CloudFile::setValue(std::size_t point, int field, double value, std::size_t element_index) {
  const auto offset = static_cast<std::size_t>(element(point, field, element_index) - data.data());
  storeElement(fields[static_cast<std::size_t>(field)].type, value, data.data() + offset);
}

int CloudFile::addField(const std::string& name, FieldType type, std::uint32_t count) {
  if (name.empty() || name.find_first_of(std::string(" \t\r\n\v\f\0", 7)) != std::string::npos)
    throw std::invalid_argument("a field name must not be empty or hold blanks: '" + name + "'");
  if (findField(name) >= 0) throw std::invalid_argument("the cloud has a field '" + name + "' already");
  if (count == 0) throw std::invalid_argument("a field needs at least one element: '" + name + "'");
  const std::size_t old_step = pointStep();
  const std::size_t new_step = old_step + sizeOf(type) * count;
  std::vector<unsigned char> rows(size() * new_step);
  for (std::size_t i = 0; old_step > 0 && i < size(); ++i)
    std::memcpy(rows.data() + i * new_step, data.data() + i * old_step, old_step);
  data = std::move(rows);
  fields.push_back({name, type, count, old_step});
  return static_cast<int>(fields.size()) - 1;
}

std::vector<double> CloudFile::column(int field) const {
  const CloudField& description = fields.at(static_cast<std::size_t>(field));
  std::vector<double> values(size());
  const std::size_t step = pointStep();
  const unsigned char* from = data.data() + description.offset;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = loadElement(description.type, from + i * step);
  return values;
}

void CloudFile::setColumn(int field, const std::vector<double>& values) {
  const CloudField& description = fields.at(static_cast<std::size_t>(field));
  if (values.size() != size()) throw std::invalid_argument("a column needs one value for every point");
  const std::size_t step = pointStep();
  unsigned char* to = data.data() + description.offset;
  for (std::size_t i = 0; i < values.size(); ++i)
    storeElement(description.type, values[i], to + i * step);
}

void CloudFile::coordinates(double* x, double* y, double* z) const {
  double* const targets[3] = {x, y, z};
  const std::size_t step = pointStep();
  for (int axis = 0; axis < 3; ++axis) {
    const CloudField& description = fields[static_cast<std::size_t>(requireAxis(*this, axis))];
    const unsigned char* from = data.data() + description.offset;
    for (std::size_t i = 0; i < size(); ++i)
      targets[axis][i] = loadElement(description.type, from + i * step);
  }
}

CloudCoordinates CloudFile::coordinates() const {
  CloudCoordinates result;
  result.x.resize(size());
  result.y.resize(size());
  result.z.resize(size());
  coordinates(result.x.data(), result.y.data(), result.z.data());
  return result;
}

void CloudFile::setCoordinate(std::size_t point, int axis, double value) {
  setValue(point, requireAxis(*this, axis), value);
}

bool CloudFile::hasNormals() const noexcept {
  for (const char* name : {"normal_x", "normal_y", "normal_z"}) {
    const int field = findField(name);
    if (field < 0 || fields[static_cast<std::size_t>(field)].count != 1) return false;
  }
  return true;
}

std::size_t CloudFile::finiteCount() const {
  const std::size_t step = pointStep();
  const CloudField* axes[3];
  for (int axis = 0; axis < 3; ++axis)
    axes[axis] = &fields[static_cast<std::size_t>(requireAxis(*this, axis))];
  std::size_t finite = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const unsigned char* row = data.data() + i * step;
    finite += std::all_of(axes, axes + 3, [row](const CloudField* field) {
      return std::isfinite(loadElement(field->type, row + field->offset));
    });
  }
  return finite;
}

CloudFile CloudFile::withoutPoints(std::size_t new_size) const {
  CloudFile result;
  result.width = static_cast<std::uint32_t>(new_size);
  if (result.width != new_size) throw std::length_error("a cloud holds at most 2^32 - 1 points");
  result.fields = fields;
  result.viewpoint = viewpoint;
  result.comments = comments;
  result.warnings = warnings;
  result.format = format;
  result.data.resize(new_size * pointStep());
  return result;
}

void CloudFile::copyRow(std::size_t from, CloudFile& target, std::size_t to) const {
  if (from >= size()) throw std::out_of_range("no such point in the cloud: " + std::to_string(from));
  const std::size_t step = pointStep();
  std::memcpy(target.data.data() + to * step, data.data() + from * step, step);
}

} // namespace pcl_gpf
