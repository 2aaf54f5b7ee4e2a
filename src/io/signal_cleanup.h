// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_gpf {

/** \brief Notes a temporary file that a signal must remove. Thread-safe.
 * \return a slot for forgetTemporary(), or -1 when all slots are taken or the path is too long
 */
int rememberTemporary(const std::string& path) noexcept;

/** \brief The file is gone or renamed. */
void forgetTemporary(int slot) noexcept;

} // namespace pcl_gpf
