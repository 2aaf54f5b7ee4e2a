// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include "pcl_gpf/common/abi_check.h"
#include "pcl_gpf/common/export.h"
#include "pcl_gpf/io/cloud_file.h"

namespace pcl_gpf {

/** \brief All points and fields as PCL's untyped cloud, in PCD names: red green blue [alpha] bytes become `rgb`
 * [`rgba`].
 *
 * is_dense is counted. The header is empty, and PCL keeps a viewpoint elsewhere (CloudFile::viewpoint).
 * \throws std::length_error when a row or the cloud passes PCL's 32-bit sizes
 */
PCL_GPF_EXPORT pcl::PCLPointCloud2 toPCL(const CloudFile& cloud);

/** \brief The way back: padding between fields goes, everything else is copied byte for byte.
 * \throws std::invalid_argument when the cloud is inconsistent (sizes, offsets, types, byte order)
 */
PCL_GPF_EXPORT CloudFile fromPCL(const pcl::PCLPointCloud2& cloud);

} // namespace pcl_gpf
