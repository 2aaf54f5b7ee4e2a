// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/common/export.h>

#include <string>

namespace pcl_gpf {

/** \brief To be called inside a catch block: throws the current exception again, an error of the core as the PCL
 * exception that a PCL user expects.
 *
 * InvalidParameter becomes pcl::BadArgumentException, UnsuitableData and ExcessiveWork become
 * pcl::ComputeFailedException; anything else passes unchanged.
 * \param[in] class_name of the filter, put in front of the message
 */
[[noreturn]] PCL_GPF_EXPORT void
rethrowAsPclException(const std::string& class_name);

} // namespace pcl_gpf
