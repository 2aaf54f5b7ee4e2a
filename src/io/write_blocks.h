// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_layout.h"

namespace pcl_gpf {

/** \brief Which number, if any, stands before the elements of a field with count > 1. */
enum class ListLengths { None, Written };

/** \brief Type of the length before a list of \a count elements. */
FieldType listLengthType(std::uint32_t count) noexcept;

/** \brief All rows as text lines, elements separated by one blank. */
void writeTextRows(const CloudFile& cloud, const OutputLayout& layout, ListLengths lengths, const ByteSink& sink);

/** \brief All rows as bytes, turned round when \a swap_bytes. */
void writeBinaryRows(const CloudFile& cloud, const OutputLayout& layout, ListLengths lengths, bool swap_bytes,
                     const ByteSink& sink);

} // namespace pcl_gpf
