// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_gpf/common/export.h"

namespace pcl_gpf {

enum class FieldType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/** \brief Bytes of one element: 1, 2, 4 or 8. */
PCL_GPF_EXPORT std::size_t sizeOf(FieldType type) noexcept;

/** \brief "int8" ... "float64", for messages and listings. */
PCL_GPF_EXPORT const char* nameOf(FieldType type) noexcept;

enum class CloudFormat { PcdAscii, PcdBinary, PcdCompressed, PlyAscii, PlyLittleEndian, PlyBigEndian, Xyz };

/** \brief "PCD ascii" ... "XYZ text", for messages and listings. */
PCL_GPF_EXPORT const char* nameOf(CloudFormat format) noexcept;

/** \brief One named column of a cloud: \a count elements of one type at byte \a offset of every row. */
struct CloudField {
  std::string name;
  FieldType type = FieldType::Float32;
  std::uint32_t count = 1;
  std::size_t offset = 0;
};

/** \brief x, y and z of all points, in cloud units. */
struct CloudCoordinates {
  std::vector<double> x, y, z;
};

/** \brief A point cloud as a file holds it: every field in its own type, in file order, rows packed.
 *
 * Names are the same for every format: normals are normal_x normal_y normal_z (nx ny nz in PLY files), colours are
 * `rgb` or `rgba` as PCD holds them, or red green blue [alpha] as PLY holds them. x, y, z always exist with count 1
 * in a cloud that was read; they may have any numeric type. Reading and writing convert names and colours.
 * Memory: size() * pointStep() bytes. Thread safety: as a standard container.
 */
class PCL_GPF_EXPORT CloudFile {
public:
  std::uint32_t width = 0;  ///< points per row of an organised cloud, else all points
  std::uint32_t height = 1; ///< rows of an organised cloud, else 1
  std::vector<CloudField> fields;
  std::vector<unsigned char> data;                      ///< size() rows of pointStep() bytes, this machine's byte order
  std::array<double, 7> viewpoint{0, 0, 0, 1, 0, 0, 0}; ///< tx ty tz, then the rotation qw qx qy qz
  std::vector<std::string> comments;                    ///< of the header, without their marks
  std::vector<std::string> warnings;                    ///< what was odd but readable, one sentence each
  CloudFormat format = CloudFormat::PcdBinary;          ///< what it was read as

  std::size_t size() const noexcept { return static_cast<std::size_t>(width) * height; }
  bool isOrganized() const noexcept { return height > 1; }
  /** \brief Bytes of one row. */
  std::size_t pointStep() const noexcept;
  /** \brief Index in fields, or -1. */
  int findField(const std::string& name) const noexcept;

  /** \brief One element as double. \note 64-bit integers above 2^53 are rounded; copy the bytes where that matters. */
  double value(std::size_t point, int field, std::size_t element = 0) const;
  /** \brief Stores \a value in the field's type, integers rounded to nearest.
   * \throws std::out_of_range when the type cannot hold it (NaN in an integer, 300 in a UInt8, 1e300 in a Float32)
   */
  void setValue(std::size_t point, int field, double value, std::size_t element = 0);
  /** \brief Appends a field of zeros and returns its index. O(bytes).
   * \throws std::invalid_argument on an empty or used name, a name with blanks, or count 0
   */
  int addField(const std::string& name, FieldType type, std::uint32_t count = 1);
  /** \brief Element 0 of the field for every point. */
  std::vector<double> column(int field) const;
  void setColumn(int field, const std::vector<double>& values);

  /** \brief x, y, z of all points, including the non-finite ones. \throws std::invalid_argument without x, y or z */
  CloudCoordinates coordinates() const;
  /** \brief The same into the caller's buffers of size() doubles each. */
  void coordinates(double* x, double* y, double* z) const;
  /** \brief Sets x (axis 0), y (1) or z (2). \throws std::out_of_range as setValue() */
  void setCoordinate(std::size_t point, int axis, double value);
  /** \brief True when normal_x, normal_y and normal_z exist with count 1. */
  bool hasNormals() const noexcept;
  /** \brief Number of points whose x, y and z are all finite (counted, never taken from the file). */
  std::size_t finiteCount() const;

  /** \brief A cloud of the given rows, in that order, repeats allowed; not organised any more.
   * \throws std::out_of_range on an index that is no point
   */
  template <typename Index = std::size_t>
  CloudFile select(const std::vector<Index>& indices) const {
    CloudFile result = withoutPoints(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      copyRow(static_cast<std::size_t>(indices[i]), result, i);
    return result;
  }

private:
  CloudFile withoutPoints(std::size_t new_size) const;
  void copyRow(std::size_t from, CloudFile& target, std::size_t to) const;
  const unsigned char* element(std::size_t point, int field, std::size_t element) const;
};

} // namespace pcl_gpf
