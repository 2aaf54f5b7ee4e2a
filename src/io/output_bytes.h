// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_layout.h"

namespace pcl_gpf {

/** \brief Writes all bytes to standard output. Calls throw IoError (kind Unwritable). */
ByteSink standardOutputSink();

} // namespace pcl_gpf
