// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "pcl_gpf/common/export.h"
#include "pcl_gpf/io/atomic_file.h" // checkWritable()
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

struct WriteOptions {
  /** \brief Default: formatForPath(). */
  std::optional<CloudFormat> format;
  /** \brief Replace an existing file. */
  bool overwrite = false;
};

/** \brief Writes all points and fields, atomically (see AtomicFile): the target is the old file or the complete new
 * one.
 *
 * Text holds the shortest digits that read back to the same bits. Between PCD and PLY, normals change their names and
 * 8-bit colours their packing: red green blue [alpha] become PCL's `rgb` [`rgba`], and back.
 * PLY holds a field of count > 1 as a list property, a 64-bit integer field as double where that is exact,
 * an organisation as obj_info num_cols/num_rows and a viewpoint as a comment line.
 * XYZ text holds x y z first, then the normals, then every other element as a column named in a comment line.
 * \note XYZ text keeps neither types nor the organisation of a cloud.
 *
 * \param path the target, or "-" for standard output (not atomic, and then without overwrite question)
 * \throws IoError (kind Unwritable): checkWritable(), a full disk, or checkFits()
 * \throws std::invalid_argument when the cloud has no x, y or z, or data does not hold size() rows
 */
PCL_GPF_EXPORT void writeCloud(const CloudFile& cloud, const std::string& path, const WriteOptions& options = {});

/** \brief The format for a path's extension (.pcd .ply .xyz .txt .asc .pts, any case), text or binary as the cloud was
 * read; the very format it was read in where the extension allows it and for "-".
 * \throws IoError (kind Unwritable) on another extension
 */
PCL_GPF_EXPORT CloudFormat formatForPath(const std::string& path, const CloudFile& cloud);

/** \brief Fails when the format cannot hold the cloud: a 64-bit integer above 2^53 in PLY, more than 4 GiB in PCD
 * compressed, more than 1000 columns. O(points) for 64-bit fields in PLY, else O(fields).
 * \throws IoError (kind Unwritable)
 */
PCL_GPF_EXPORT void checkFits(const CloudFile& cloud, CloudFormat format, const std::string& path);

} // namespace pcl_gpf
