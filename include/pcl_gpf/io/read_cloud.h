// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "pcl_gpf/common/export.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

/** \brief Reads a whole PCD (ascii, binary, binary_compressed), PLY (ascii, little and big endian) or XYZ text file.
 *
 * The content decides the format, not the name. XYZ text has no mark of its own, so it is tried only for the
 * extensions .xyz .txt .asc .pts .csv and for standard input: 3 columns are x y z, 6 are x y z and the normal, other
 * columns are named c4, c5 ... unless a comment "# columns: NAME ..." names them; all are Float64; lines that start
 * with # or // are comments; a first line with one integer is the number of points (PTS).
 *
 * Strict: every header entry once, every count exact, every number whole, the promised bytes there before anything is
 * allocated. Numbers do not depend on the locale. Odd but unambiguous things (a byte-order mark, trailing bytes, mixed
 * line ends) are named in CloudFile::warnings. Padding fields (`_`) of PCD are dropped. A PLY list property of
 * constant length becomes a field of that count; one of varying length is dropped with a warning. PLY elements other
 * than `vertex` are checked and skipped, except the `camera` that PCL writes: it gives the viewpoint.
 *
 * \param path a regular file, or "-" for standard input
 * \return the cloud, possibly with 0 points or with non-finite ones: judging that is the caller's business
 * \throws IoError (kind Unreadable) with file, line or byte, what was promised and what was found
 * \throws std::bad_alloc when the file does not fit in memory
 * Memory: the file's bytes plus the cloud's while reading; the cloud is at most 12 times the file
 * (compressed: 88 times, the most that LZF can shrink). Cost: one pass.
 */
PCL_GPF_EXPORT CloudFile readCloud(const std::string& path);

/** \brief The same from memory. \param name stands for the path in messages, and its extension allows XYZ text. */
PCL_GPF_EXPORT CloudFile readCloudBuffer(const unsigned char* data, std::size_t size, const std::string& name);

} // namespace pcl_gpf
