// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/text_lines.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

// One reader per format. Each takes the whole file and gives the whole cloud or throws IoError.
CloudFile readPcd(const Source& source);
CloudFile readPly(const Source& source);
CloudFile readXyz(const Source& source);

/** \brief Fails unless x, y and z exist with one element each. */
void requireCoordinates(const Source& source, const CloudFile& cloud);

/** \brief Adds a warning when text follows the last promised line. */
void reportTrailingLines(LineReader& lines, CloudFile& cloud);

/** \brief Adds a warning when bytes follow the last promised one. */
void reportTrailingBytes(std::size_t bytes, CloudFile& cloud);

/** \brief Fails unless \a rows rows of at least \a row_bytes bytes fit into the \a left bytes of the body. */
void requireBytes(const Source& source, std::size_t body, std::uint64_t rows, std::uint64_t row_bytes,
                  std::size_t left);

} // namespace pcl_gpf
