// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/text_lines.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

struct PlyProperty {
  std::string name;
  FieldType type = FieldType::Float32; ///< of the value or of the list's entries
  bool is_list = false;
  FieldType length_type = FieldType::UInt8; ///< lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* find(const std::string& property) const noexcept;
  bool hasLists() const noexcept;
  /** \brief Bytes of a row in a binary file when every list is empty. */
  std::size_t minimumBytes() const noexcept;
};

/** \brief What a PLY header promises. */
struct PlyHeader {
  std::vector<PlyElement> elements;
  std::vector<std::string> comments; ///< of comment and obj_info lines, the latter with that word
  CloudFormat format = CloudFormat::PlyAscii;
};

/** \brief Reads the header up to and including end_header and makes sure that the promised rows can fit in the bytes
 * that follow; \a lines then stands at the body. \throws IoError
 */
PlyHeader readPlyHeader(LineReader& lines);

/** \brief The name of a type in a PLY header ("float"), or nullptr for the 64-bit integers that PLY lacks. */
const char* plyTypeName(FieldType type) noexcept;

} // namespace pcl_gpf
