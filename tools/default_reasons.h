// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_gpf {

/** \brief Why the default of a field of DenoiseParameters is what it is, in one phrase; empty where there is nothing to tell. */
std::string
reasonOfDefault(const std::string& field);

} // namespace pcl_gpf
