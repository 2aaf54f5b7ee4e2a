// SPDX-License-Identifier: BSD-3-Clause
#include "consolidated_file.h"

#include "field_types.h"

#include <array>
#include <string>
#include <vector>

namespace pcl_gpf {

CloudFile
consolidatedFile(const CloudFile& source, const ConsolidatedCloud& cloud)
{
  const std::vector<std::string> axes{"x", "y", "z"}, normals{"normal_x", "normal_y", "normal_z"};
  CloudFile file = source.select(cloud.source_rows);
  promoteIntegerFields(file, axes, FieldType::Float64);
  widenCoordinates(file, cloud.x, cloud.y, cloud.z);
  promoteIntegerFields(file, normals, FieldType::Float32);
  const std::array<const std::vector<double>*, 3> positions{&cloud.x, &cloud.y, &cloud.z};
  const std::array<const std::vector<float>*, 3> directions{&cloud.normal_x, &cloud.normal_y, &cloud.normal_z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int field = file.findField(normals[axis]);
    if (field < 0)
      field = file.addField(normals[axis], FieldType::Float32);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      file.setCoordinate(i, static_cast<int>(axis), (*positions[axis])[i]);
      file.setValue(i, field, static_cast<double>((*directions[axis])[i]));
    }
  }
  return file;
}

} // namespace pcl_gpf
