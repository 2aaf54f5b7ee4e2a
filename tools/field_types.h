// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/io/cloud_file.h>

#include <string>
#include <vector>

namespace pcl_gpf {

/** \brief Gives the named fields another type; the others keep their bytes. Names that the cloud does not have are left out.
 * \throws std::out_of_range when a value does not fit */
void
changeFieldTypes(CloudFile& cloud, const std::vector<std::string>& names, FieldType type);

/** \brief Changes to `type` those of the named fields that hold integers. \return their names */
std::vector<std::string>
promoteIntegerFields(CloudFile& cloud, const std::vector<std::string>& names, FieldType type);

/** \brief Makes the coordinates double if any of these finite values is beyond float, as moves at its limit may be. */
void
widenCoordinates(CloudFile& cloud, const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z);

} // namespace pcl_gpf
