// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/row_map.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

/** \brief Takes the next bytes of a file. */
using ByteSink = std::function<void(const void* bytes, std::size_t size)>;

/** \brief The rows as a format wants them: names, order, packing of colours; types stay. */
struct OutputLayout {
  std::vector<CloudField> fields; ///< offsets in the output's rows
  std::size_t step = 0;           ///< bytes of an output row
  RowMap map;                     ///< from rows of the cloud

  /** \brief Appends a field; returns where its bytes go. */
  std::size_t add(const std::string& name, FieldType type, std::uint32_t count = 1);
};

/** \brief red green blue [alpha] of one byte each become `rgb` [`rgba`], where those names are free. */
OutputLayout pcdLayout(const CloudFile& cloud);

/** \brief `rgb` or `rgba` become red green blue [alpha], normal_x becomes nx ..., where those names are free. */
OutputLayout plyLayout(const CloudFile& cloud);

/** \brief As PLY but with the common names of normals; x y z first, then the normals. */
OutputLayout xyzLayout(const CloudFile& cloud);

/** \brief True for a field that holds a packed colour of PCL: rgb or rgba, 4 bytes. */
bool isPackedColour(const CloudField& field) noexcept;

} // namespace pcl_gpf
