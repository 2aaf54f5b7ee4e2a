// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

constexpr bool kHostIsLittleEndian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

/** \brief Longest text of one element by formatElement(). */
constexpr std::size_t kMaxElementText = 32;

/** \brief One element of \a type at \a from (any alignment, this machine's byte order). */
double loadElement(FieldType type, const unsigned char* from);

/** \brief Stores \a value, integers rounded to nearest. \throws std::out_of_range when the type cannot hold it */
void storeElement(FieldType type, double value, unsigned char* to);

/** \brief Parses a whole token, locale-free, with an optional leading plus; reals beyond the type's range become
 * infinite or zero. \return false when the token is no number of this type; \a to is then unchanged
 */
bool parseElement(FieldType type, std::string_view token, unsigned char* to);
bool parseReal(std::string_view token, double& value);

/** \brief Writes the shortest text that parseElement() reads back to the same bits (of a NaN only "nan").
 * \return the end of the text; at most kMaxElementText bytes
 */
char* formatElement(FieldType type, const unsigned char* from, char* to);

/** \brief Reverses the bytes of each of \a count elements of \a size bytes. */
void swapElements(unsigned char* bytes, std::size_t size, std::size_t count);

} // namespace pcl_gpf
