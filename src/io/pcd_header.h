// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "io/text_lines.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

/** \brief What a PCD header promises. */
struct PcdHeader {
  std::vector<CloudField> columns; ///< as the file lays them out, padding fields `_` included
  std::size_t step = 0;            ///< bytes of one row in the file
  CloudFile cloud;                 ///< width, height, viewpoint, comments, format; no fields and no data yet
};

/** \brief Reads the header up to and including the DATA line; \a lines then stands at the body. \throws IoError */
PcdHeader readPcdHeader(LineReader& lines);

/** \brief True for a keyword that may start a line of a PCD header. */
bool isPcdKeyword(std::string_view token);

} // namespace pcl_gpf
