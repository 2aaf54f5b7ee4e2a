// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/io/cloud_file.h>
#include <pcl_gpf/io/write_mesh.h>
#include <pcl_gpf/pipeline/mesh.h>

namespace pcl_gpf {

/** \brief The mesh as it is written: with normals, and with the colours of the points that the vertices come from, if `source` has any.
 * \param[in] source the cloud that result.source_rows point into */
MeshFile
meshFile(const MeshResult& result, CloudFile source);

/** \brief Coordinates in double where the cloud has them in double. */
MeshWriteOptions
meshWriteOptions(const CloudFile& source, bool overwrite);

} // namespace pcl_gpf
