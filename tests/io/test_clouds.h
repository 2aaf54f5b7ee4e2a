// SPDX-License-Identifier: BSD-3-Clause
// Clouds and places to write them for the tests of the input/output layer.
#pragma once

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf::test {

constexpr CloudFormat kAllFormats[] = {CloudFormat::PcdAscii, CloudFormat::PcdBinary,       CloudFormat::PcdCompressed,
                                       CloudFormat::PlyAscii, CloudFormat::PlyLittleEndian, CloudFormat::PlyBigEndian,
                                       CloudFormat::Xyz};
constexpr FieldType kAllTypes[] = {FieldType::Int8,    FieldType::UInt8,  FieldType::Int16, FieldType::UInt16,
                                   FieldType::Int32,   FieldType::UInt32, FieldType::Int64, FieldType::UInt64,
                                   FieldType::Float32, FieldType::Float64};

/** A folder that is removed, with all in it, at the end of the test. */
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pcl_gpf_io_XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + '/' + name; }
  const std::string& path() const { return path_; }
  /** Number of entries: shows a temporary file that was left. */
  std::ptrdiff_t entries() const {
    return std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator());
  }

private:
  std::string path_;
};

inline std::string bytesOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void writeBytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string extensionFor(CloudFormat format) {
  if (format == CloudFormat::Xyz) return ".xyz";
  return std::string(nameOf(format)).substr(0, 3) == "PCD" ? ".pcd" : ".ply";
}

/** x y z in float, otherwise empty. */
inline CloudFile cloudOf(const std::vector<std::array<double, 3>>& points) {
  CloudFile cloud;
  cloud.width = static_cast<std::uint32_t>(points.size());
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, FieldType::Float32);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      cloud.setCoordinate(i, axis, points[i][static_cast<std::size_t>(axis)]);
  return cloud;
}

/** Random bits in every byte, except that NaNs are made the one that text can hold. */
inline void fillRandom(CloudFile& cloud, std::uint32_t seed) {
  std::mt19937 generator(seed);
  for (unsigned char& byte : cloud.data)
    byte = static_cast<unsigned char>(generator() >> 24);
  const float float_nan = std::numeric_limits<float>::quiet_NaN();
  const double double_nan = std::numeric_limits<double>::quiet_NaN();
  for (const CloudField& field : cloud.fields) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      for (std::size_t k = 0; k < field.count; ++k) {
        unsigned char* element = cloud.data.data() + i * cloud.pointStep() + field.offset + k * sizeOf(field.type);
        const double value = cloud.value(i, cloud.findField(field.name), k);
        if (value == value) continue;
        if (field.type == FieldType::Float32)
          std::memcpy(element, &float_nan, sizeof float_nan);
        else
          std::memcpy(element, &double_nan, sizeof double_nan);
      }
    }
  }
}

/** Twelve fields of all types, some with several elements, organised, with NaN holes and a viewpoint. */
inline CloudFile mixedCloud(std::uint32_t width, std::uint32_t height, std::uint32_t seed) {
  CloudFile cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.addField("before", FieldType::UInt8);
  cloud.addField("x", FieldType::Float32);
  cloud.addField("i8", FieldType::Int8, 3);
  cloud.addField("y", FieldType::Float64);
  cloud.addField("u16", FieldType::UInt16);
  cloud.addField("i16", FieldType::Int16);
  cloud.addField("z", FieldType::Int32);
  cloud.addField("u32", FieldType::UInt32);
  cloud.addField("histogram", FieldType::Float32, 33);
  cloud.addField("time", FieldType::UInt64);
  cloud.addField("offset", FieldType::Int64, 2);
  cloud.addField("many", FieldType::UInt8, 300);
  fillRandom(cloud, seed);
  for (std::size_t i = 0; i < cloud.size(); i += 7)
    cloud.setValue(i, 1, std::numeric_limits<double>::quiet_NaN());
  cloud.viewpoint = {1e-300, -500000.123456789, 0.1, 0.5, -0.5, 0.5, -0.5};
  cloud.comments = {"made by a test", "with two comments"};
  return cloud;
}

/** 64-bit integers cut to 50 bits, which PLY and a double can hold. */
inline void limitWideIntegers(CloudFile& cloud) {
  for (const CloudField& field : cloud.fields) {
    if (field.type != FieldType::Int64 && field.type != FieldType::UInt64) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      for (std::size_t k = 0; k < field.count; ++k) {
        unsigned char* element = cloud.data.data() + i * cloud.pointStep() + field.offset + k * 8;
        std::uint64_t bits = 0;
        std::memcpy(&bits, element, sizeof bits);
        bits >>= 14;
        std::memcpy(element, &bits, sizeof bits);
      }
    }
  }
}

} // namespace pcl_gpf::test
