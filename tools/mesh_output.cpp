// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_output.h"

#include "render/point_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_gpf {

MeshFile
meshFile(const MeshResult& result, CloudFile source)
{
  MeshFile file;
  file.mesh.vertices = result.vertices;
  file.mesh.triangles = result.triangles;
  file.normals = result.normals;
  PictureCloud cloud;
  cloud.file = std::move(source);
  cloud.rows = result.source_rows;
  for (const Color& color : colorsInFile(cloud))
    for (const float channel : color)
      file.colors.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(channel, 0.0f, 1.0f))));
  return file;
}

MeshWriteOptions
meshWriteOptions(const CloudFile& source, bool overwrite)
{
  const int x = source.findField("x");
  MeshWriteOptions options;
  options.overwrite = overwrite;
  options.double_coordinates = x >= 0 && source.fields[static_cast<std::size_t>(x)].type == FieldType::Float64;
  return options;
}

} // namespace pcl_gpf
